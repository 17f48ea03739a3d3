#include <skein/scene/fiber_spacing.hpp>

#include "scene_checks.hpp"
#include "scene_numbers.hpp"
#include "scene_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace skein {
namespace {

/// A rigid fiber's resistance is two matrices, [n_nodes, n_nodes].
constexpr int n_rigid_nodes_allowed = 2000;

/// How many radii apart sections may be, and how many lie within one at most: further on a rounding error is as large
/// as what bends a fiber.
constexpr double most_apart = 1e4;

/// What a rigid fiber cannot be asked for.
void check_rigid(const FiberConfig& fiber, const std::string& path, const SceneReader& reader,
                 std::vector<Problem>& problems) {
  const auto reject_bend = [&](const char* key, const double value) {
    if (value > 0.0)
      reader.add(problems, path + "." + key,
                 fmt::format("{0}.{1} {2}: a rigid fiber is straight; set it to 0, or take model = \"chain\"", path,
                             key, format_number(value)));
  };
  reject_bend("start_amplitude", fiber.start_amplitude);
  reject_bend("start_noise", fiber.start_noise);
  const int n_nodes = lay_out_chain(fiber).sections;
  if (n_nodes <= n_rigid_nodes_allowed) return;
  if (fiber.chain_nodes > 0)
    reader.add(problems, path + ".chain_nodes",
               fmt::format("{}.chain_nodes {}: a rigid fiber has {} at most", path, n_nodes, n_rigid_nodes_allowed));
  else
    reader.add(problems, path + ".sections",
               fmt::format("{}.sections {}: a rigid fiber would have {} nodes, and {} is the most: {}, or take model = "
                           "\"chain\"",
                           path, fiber.sections, n_nodes, n_rigid_nodes_allowed,
                           fiber.stands_for_tube() ? "set chain_nodes" : "take fewer"));
}

/// What a helix cannot be asked for.
void check_helix(const FiberConfig& fiber, const std::string& path, const SceneReader& reader,
                 std::vector<Problem>& problems) {
  if (!fiber.is_helix()) return;
  const auto reject = [&](const char* key, const std::string& why) {
    reader.add(problems, path + "." + key, fmt::format("{}.{} {}", path, key, why));
  };
  if (fiber.is_line())
    reject("helix_radius", fmt::format("{}: chains and rigid fibers are straight at rest; take a tube",
                                       format_number(fiber.helix_radius)));
  constexpr double shortest_pitch = 6.0;  // radii, of neighbouring turns that do not touch, with some play
  if (!(std::abs(fiber.helix_pitch) >= shortest_pitch * fiber.radius))
    reject("helix_pitch",
           fmt::format("{}: a turn takes {:g} radii along the axis at least, {}", format_number(fiber.helix_pitch),
                       shortest_pitch, format_number(shortest_pitch * fiber.radius)));
  if (fiber.start_amplitude > 0.0 || fiber.start_noise > 0.0)
    reject(fiber.start_amplitude > 0.0 ? "start_amplitude" : "start_noise",
           "bends a straight fiber; a helix starts as it is at rest");
  const double wave_number = 6.283185307179586 / fiber.helix_pitch;
  const double bent = fiber.radius * fiber.helix_radius * wave_number * wave_number /
                      (1.0 + fiber.helix_radius * fiber.helix_radius * wave_number * wave_number);
  constexpr double most_bent = 0.3;
  if (bent > most_bent)
    reject("helix_radius",
           fmt::format("{}: with this pitch it bends the tube to a curvature of {:.3g} / radius, and {} "
                       "is the most",
                       format_number(fiber.helix_radius), bent, most_bent));
}

/// What a line and a tube cannot both be asked for.
void check_model(const FiberConfig& fiber, const std::string& path, const SceneReader& reader,
                 std::vector<Problem>& problems) {
  const auto reject = [&](const char* key, const std::string& why) {
    reader.add(problems, path + "." + key, fmt::format("{}.{} {}", path, key, why));
  };
  const bool is_bare = fiber.is_line() && fiber.nodes_per_section == 1;
  if (fiber.nodes_per_section < 3 && !is_bare)
    reject("nodes_per_section", fmt::format("{}: a tube has 3 or more, also one that a chain or a rigid fiber stands "
                                            "for; 1 is of these in their own right",
                                            fiber.nodes_per_section));
  if (is_bare && fiber.spacing == 0.0)
    reject("spacing", "must be given: single nodes have no neighbours on a section to take it from");
  if (fiber.spacing > 0.0 &&
      !(fiber.spacing >= fiber.radius / most_apart && fiber.spacing <= fiber.radius * most_apart))
    reject("spacing",
           fmt::format("{}: sections that are {:.3g} radii apart make up no fiber; between {} and {} they do",
                       format_number(fiber.spacing), fiber.spacing / fiber.radius, 1.0 / most_apart, most_apart));
  if (is_bare && fiber.reach_along != 1)
    reject("reach_along", fmt::format("{}: links of a chain join neighbours", fiber.reach_along));
  const auto keep_bare = [&](const char* key, const double value) {
    if (!is_bare && value > 0.0)
      reject(key,
             "is of a chain or a rigid fiber with nodes_per_section = 1; a tube's follows from its springs and nodes");
  };
  keep_bare("bending_rigidity", fiber.bending_rigidity);
  keep_bare("shear_couple", fiber.shear_couple);
  keep_bare("end_couple", fiber.end_couple);
  check_helix(fiber, path, reader, problems);
  if (fiber.is_rigid()) check_rigid(fiber, path, reader, problems);
  if (fiber.chain_nodes == 0) return;
  if (!fiber.stands_for_tube())
    reject("chain_nodes",
           fmt::format("{}: only a chain or a rigid fiber that stands for a tube, with nodes_per_section = 3 or more, "
                       "has another number of nodes than sections",
                       fiber.chain_nodes));
  else if (fiber.chain_nodes < 3)
    reject("chain_nodes", fmt::format("{}: a line that stands for a tube needs 3", fiber.chain_nodes));
  else if (lay_out_chain(fiber).spacing < 0.5 * fiber.radius)
    reject("chain_nodes",
           fmt::format("{} lie {:.3g} apart, less than half a radius: at most {:.0f} fit", fiber.chain_nodes,
                       lay_out_chain(fiber).spacing,
                       std::floor(2.0 * fiber.sections * compute_section_spacing(fiber) / fiber.radius)));
}

void check_fiber(const FiberConfig& fiber, const std::string& path, const SceneReader& reader,
                 std::vector<Problem>& problems, std::vector<Problem>& warnings) {
  if (!(norm(fiber.direction) >= smallest_direction)) {
    reader.add(problems, path + ".direction", path + ".direction is zero: it points nowhere");
  }
  if (fiber.nodes_per_section == 1) return;  // blobs of a line make up for the radius
  const double spacing = std::max(compute_node_spacing(fiber), compute_section_spacing(fiber));
  if (fiber.blob > fiber.radius) {
    reader.add(warnings, path + ".blob",
               fmt::format("{}.blob {} is above the radius {}: the fiber is too thick in the fluid", path,
                           format_number(fiber.blob), format_number(fiber.radius)));
  } else if (fiber.blob < 0.5 * spacing) {
    reader.add(warnings, path + ".blob",
               fmt::format("{}.blob {} is below half of the node spacing {:.4g}: the surface leaks", path,
                           format_number(fiber.blob), spacing));
  }
}

}  // namespace

void check_profile(const std::vector<ProfilePoint>& profile, const std::string& path, const double least_factor,
                   const SceneReader& reader, std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const bool is_ordered = i == 0 || profile[i].position > profile[i - 1].position;
    if (is_ordered && profile[i].position <= 1.0 && profile[i].factor >= least_factor) continue;
    reader.add(problems, path,
               fmt::format("{}: pair {} is [{}, {}]; positions grow from 0 to 1, factors are {}", path, i,
                           format_number(profile[i].position), format_number(profile[i].factor),
                           least_factor > 0.0 ? "above 0" : "0 or more"));
    return;
  }
}

void check_fibers(const SceneConfig& scene, const SceneReader& reader, std::vector<Problem>& problems,
                  std::vector<Problem>& warnings) {
  for (std::size_t i = 0; i < scene.fibers.size(); ++i) {
    const std::string path = reader.path_of("fiber", i);
    if (!reader.is_sound(path)) continue;
    check_model(scene.fibers[i], path, reader, problems);
    check_fiber(scene.fibers[i], path, reader, problems, warnings);
    check_profile(scene.fibers[i].stiffness_profile, path + ".stiffness_profile", 1e-6, reader, problems);
  }
}

}  // namespace skein
