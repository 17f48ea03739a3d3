#include <skein/scene/fiber_spacing.hpp>
#include <skein/scene/scene_size.hpp>

#include "scene_checks.hpp"
#include "scene_numbers.hpp"
#include "scene_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

namespace skein {
namespace {

// Sections of one fiber repel each other from 10 radii of arclength on, and a tight bend brings these to a gap of
// about 4. Where a range is so short that sections see less than their spacing, fibers feel rough.
void check_repulsion(const SceneConfig& scene, const SceneReader& reader, std::vector<Problem>& problems,
                     std::vector<Problem>& warnings) {
  if (scene.repulsion.strength == 0.0) return;
  double thinnest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.fibers.size(); ++i) {
    if (!reader.is_sound(reader.path_of("fiber", i))) return;
    thinnest = std::min(thinnest, scene.fibers[i].radius);
  }
  const double range = scene.repulsion.range;
  constexpr double least_radii = 0.01, most_radii = 4.0;
  if (range > 0.0 && (range < least_radii * thinnest || range > most_radii * thinnest)) {
    reader.add(
        problems, "repulsion.range",
        fmt::format("repulsion.range {} is not between {:g} and {:g}, {:g} and {:g} radii of the thinnest fiber",
                    format_number(range), least_radii * thinnest, most_radii * thinnest, least_radii, most_radii));
    return;
  }
  for (std::size_t i = 0; i < scene.fibers.size(); ++i) {
    const FiberConfig fiber = lay_out_chain(scene.fibers[i]);
    const double spacing = compute_section_spacing(fiber);
    const double half_width = std::sqrt(4.0 * fiber.radius * (range > 0.0 ? range : thinnest));
    if (half_width >= spacing) continue;
    reader.add(
        warnings, "repulsion.range",
        fmt::format("repulsion.range is so short that a section of {} sees others within {:.3g} of it only, less "
                    "than their distance {:.3g}: fibers feel each other's sections one by one",
                    reader.path_of("fiber", i), half_width, spacing));
    return;
  }
}

void check_gravity(const GravityConfig& gravity, const SceneReader& reader, std::vector<Problem>& problems) {
  if (!(norm(gravity.direction) >= smallest_direction))
    reader.add(problems, "gravity.direction", "gravity.direction is zero: it points nowhere");
}

/// What acts on a section of a fiber needs both of them. @param loads  with a fiber and a section each
template <class Load>
void check_loads(const std::string& table, const std::vector<Load>& loads, const SceneConfig& scene,
                 const SceneReader& reader, std::vector<Problem>& problems) {
  const double n_fibers = count_fibers(scene);
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const std::string path = reader.path_of(table, i);
    if (!reader.is_sound(path) || scene.fibers.empty()) continue;
    const Load& load = loads[i];
    if (load.fiber >= n_fibers) {
      reader.add(problems, path + ".fiber",
                 fmt::format("{}.fiber {}: the scene's fibers are 0 to {:.0f}", path, load.fiber, n_fibers - 1.0));
      continue;
    }
    // Copies are made of the list's fibers in turn.
    const std::size_t model = static_cast<std::size_t>(load.fiber) % scene.fibers.size();
    const int n_sections = lay_out_chain(scene.fibers[model]).sections;
    if (!reader.is_sound(reader.path_of("fiber", model)) || (load.section >= -n_sections && load.section < n_sections))
      continue;
    reader.add(problems, path + ".section",
               fmt::format("{}.section {}: sections of fiber {} are 0 to {}, or -{} to -1 from the end", path,
                           load.section, load.fiber, n_sections - 1, n_sections));
  }
}

/// Of what turns sections. @param loads  with a fiber each
template <class Load>
void check_turned(const std::string& table, const std::vector<Load>& loads, const SceneConfig& scene,
                  const SceneReader& reader, std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const std::string path = reader.path_of(table, i);
    const int fiber = loads[i].fiber;
    if (!reader.is_sound(path) || scene.fibers.empty() || fiber >= count_fibers(scene)) continue;
    if (scene.fibers[static_cast<std::size_t>(fiber) % scene.fibers.size()].is_line())
      reader.add(problems, path + ".fiber",
                 fmt::format("{}.fiber {}: sections of chains and rigid fibers are points, which no {} turns; "
                             "[[tether]]s may pull at "
                             "two of them",
                             path, fiber, table));
  }
}

void check_clamps(const std::vector<ClampConfig>& clamps, const SceneReader& reader, std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < clamps.size(); ++i) {
    const std::string path = reader.path_of("clamp", i);
    if (reader.is_sound(path) && !(norm(clamps[i].direction) >= smallest_direction))
      reader.add(problems, path + ".direction", path + ".direction is zero: it points nowhere");
  }
}

/// What a wave asks of a tube: its springs shorten and lengthen by half at most.
void check_undulations(const SceneConfig& scene, const SceneReader& reader, std::vector<Problem>& problems) {
  constexpr double most_bent = 0.5;
  std::map<int, double> bent;
  for (std::size_t i = 0; i < scene.undulations.size(); ++i) {
    const std::string path = reader.path_of("undulation", i);
    const UndulationConfig& wave = scene.undulations[i];
    if (!reader.is_sound(path) || scene.fibers.empty()) continue;
    check_profile(wave.envelope, path + ".envelope", 0.0, reader, problems);
    if (wave.fiber >= count_fibers(scene)) {
      reader.add(
          problems, path + ".fiber",
          fmt::format("{}.fiber {}: the scene's fibers are 0 to {:.0f}", path, wave.fiber, count_fibers(scene) - 1.0));
      continue;
    }
    const std::size_t model = static_cast<std::size_t>(wave.fiber) % scene.fibers.size();
    const FiberConfig& fiber = scene.fibers[model];
    if (!reader.is_sound(reader.path_of("fiber", model))) continue;
    if (fiber.is_line()) {
      reader.add(
          problems, path + ".fiber",
          fmt::format("{}.fiber {}: chains and rigid fibers have no sides to bend to; take a tube", path, wave.fiber));
      continue;
    }
    double highest = 0.0;
    for (const ProfilePoint& point : wave.envelope) highest = std::max(highest, point.factor);
    const double own = highest * std::abs(wave.curvature) * fiber.radius;
    const double sum = bent[wave.fiber] += own;
    if (own > 0.0 && sum > most_bent)
      reader.add(problems, path + ".curvature",
                 fmt::format("{}.curvature {}: the waves of fiber {} bend it to a curvature of {:.3g} / radius, and "
                             "{} is the most",
                             path, format_number(wave.curvature), wave.fiber, sum, most_bent));
  }
}

}  // namespace

void check_forces(const SceneConfig& scene, const SceneReader& reader, std::vector<Problem>& problems,
                  std::vector<Problem>& warnings) {
  if (reader.is_sound("repulsion")) check_repulsion(scene, reader, problems, warnings);
  if (reader.is_sound("gravity")) check_gravity(scene.gravity, reader, problems);
  if (!reader.is_sound("placement")) return;
  check_loads("tether", scene.tethers, scene, reader, problems);
  check_loads("torque", scene.torques, scene, reader, problems);
  check_loads("clamp", scene.clamps, scene, reader, problems);
  check_turned("torque", scene.torques, scene, reader, problems);
  check_turned("clamp", scene.clamps, scene, reader, problems);
  check_clamps(scene.clamps, reader, problems);
  check_undulations(scene, reader, problems);
}

}  // namespace skein
