#include "scene_checks.hpp"

#include <skein/scene/fiber_spacing.hpp>
#include <skein/scene/scene_size.hpp>

#include "scene_numbers.hpp"
#include "scene_value.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace skein {
namespace {

constexpr double n_nodes_allowed = 1e8;
constexpr double n_copies_allowed = 1e4;
constexpr double n_frames_allowed = 1e7;
constexpr double n_steps_allowed = 1e12;
constexpr double least_duration = 1e-6;  // over the start: less leaves too few digits for steps and frames

void check_flow(const FlowConfig& flow, const std::string& path, const SceneReader& reader,
                std::vector<Problem>& problems) {
  if (flow.stop > 0.0 && flow.stop < flow.start)
    reader.add(
        problems, path + ".stop",
        fmt::format("{0}.stop {1} is before {0}.start {2}", path, format_number(flow.stop), format_number(flow.start)));
}

void check_placement(const PlacementConfig& placement, const SceneReader& reader, std::vector<Problem>& problems) {
  const Vec3 n = placement.grid;
  if (n.x != std::floor(n.x) || n.y != std::floor(n.y) || n.z != std::floor(n.z))
    reader.add(problems, "placement.grid",
               fmt::format("placement.grid must be three whole numbers, not {}", format_vector(n)));
  else if (placement.kind == PlacementKind::grid && n.x * n.y * n.z > n_copies_allowed)
    reader.add(problems, "placement.grid",
               fmt::format("placement.grid asks for {:g} fibers, more than {:g}", n.x * n.y * n.z, n_copies_allowed));
}

void check_node_count(const SceneConfig& scene, const SceneReader& reader, std::vector<Problem>& problems) {
  double n_nodes = 0.0;
  for (std::size_t i = 0; i < scene.fibers.size(); ++i) {
    if (!reader.is_sound(reader.path_of("fiber", i))) return;
    const FiberConfig fiber = lay_out_chain(scene.fibers[i]);
    n_nodes += count_copies(scene, i) * fiber.sections * fiber.nodes_per_section;
    if (n_nodes <= n_nodes_allowed) continue;
    reader.add(
        problems, reader.path_of("fiber", i) + ".sections",
        fmt::format("with this fiber the scene has {:.3g} nodes (sections * nodes_per_section), more than {:.0e}",
                    n_nodes, n_nodes_allowed));
    return;
  }
}

// What a key of fmm would change must not be passed over; the tolerance and the like have a meaning in every scene.
void check_hydrodynamics(const HydrodynamicsConfig& hydrodynamics, const SceneReader& reader,
                         std::vector<Problem>& problems) {
  if (hydrodynamics.method != SumMethod::direct) return;
  const auto reject = [&](const char* key, const int value) {
    if (value == 0) return;
    reader.add(
        problems, fmt::format("hydrodynamics.{}", key),
        fmt::format("hydrodynamics.{} {} is of the fast multipole method, and method is \"direct\"", key, value));
  };
  reject("order", hydrodynamics.order);
  reject("leaf_size", hydrodynamics.leaf_size);
}

void check_ends(const TimeConfig& time, const SceneReader& reader, std::vector<Problem>& problems) {
  if (time.end < time.start)
    reader.add(problems, "time.end",
               fmt::format("time.end {} is before time.start {}", format_number(time.end), format_number(time.start)));
  const double duration = time.end - time.start;
  if (0.0 < duration && duration < least_duration * time.start)
    reader.add(problems, "time.end",
               fmt::format("time.end {} is so near to time.start {} that steps would be lost in rounding",
                           format_number(time.end), format_number(time.start)));
  for (std::size_t i = 0; i < time.earlier_ends.size(); ++i) {
    const double end = time.earlier_ends[i];
    const double next = i + 1 < time.earlier_ends.size() ? time.earlier_ends[i + 1] : time.end;
    if (time.start <= end && end < next) continue;
    reader.add(problems, "time.earlier_ends",
               fmt::format("time.earlier_ends {} must grow from time.start {} and stay below time.end {}",
                           format_numbers(time.earlier_ends), format_number(time.start), format_number(time.end)));
    return;
  }
}

void check_time(const TimeConfig& time, const SceneReader& reader, std::vector<Problem>& problems) {
  if (time.method == TimeMethod::euler && time.step == 0.0) {
    reader.add(problems, "time.step", "time.step must be given and above 0: euler has no error control");
  }
  if (time.max_step > 0.0 && time.step > time.max_step) {
    reader.add(
        problems, "time.step",
        fmt::format("time.step {} is above time.max_step {}", format_number(time.step), format_number(time.max_step)));
  }
  check_ends(time, reader, problems);
  const double shortest = time.step > 0.0 ? time.step : time.max_step;
  const double n_steps = shortest > 0.0 ? (time.end - time.start) / shortest : 0.0;
  if (n_steps > n_steps_allowed) {
    reader.add(problems, "time.end",
               fmt::format("time.end {} would take {:.2g} steps", format_number(time.end), n_steps));
  }
}

void check_method(const SceneConfig& scene, const SceneReader& reader, std::vector<Problem>& problems) {
  if (scene.time.method != TimeMethod::trbdf2) return;
  for (std::size_t i = 0; i < scene.fibers.size(); ++i)
    if (scene.fibers[i].is_rigid())
      return reader.add(
          problems, "time.method",
          fmt::format("time.method \"trbdf2\" is for stiff springs, and does not know what keeps {} rigid; "
                      "take \"rkc2\", or \"bs3\" where all fibers are rigid",
                      reader.path_of("fiber", i)));
}

void check_frame_count(const SceneConfig& scene, const SceneReader& reader, std::vector<Problem>& problems) {
  if (scene.output.frame_interval == 0.0) return;  // the scene's own time sets it
  const double n_frames = (scene.time.end - scene.time.start) / scene.output.frame_interval;
  if (n_frames <= n_frames_allowed) return;
  reader.add(problems, "output.frame_interval",
             fmt::format("output.frame_interval {} would make {:.2g} frames until time.end {}",
                         format_number(scene.output.frame_interval), n_frames, format_number(scene.time.end)));
}

// It is a part of a file's name.
void check_start(const StartConfig& start, const SceneReader& reader, std::vector<Problem>& problems) {
  const bool is_checksum =
      start.checksum.size() == 16 && start.checksum.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (start.checksum.empty() || is_checksum) return;
  reader.add(problems, "start.checksum",
             fmt::format("start.checksum must be 16 hexadecimal digits, as 'skein run --from' writes them, not {}",
                         format_text(start.checksum)));
}

}  // namespace

void check_scene(const SceneConfig& scene, const SceneReader& reader, std::vector<Problem>& problems,
                 std::vector<Problem>& warnings) {
  check_fibers(scene, reader, problems, warnings);
  for (std::size_t i = 0; i < scene.flows.size(); ++i) {
    const std::string path = reader.path_of("flow", i);
    if (reader.is_sound(path)) check_flow(scene.flows[i], path, reader, problems);
  }
  if (reader.is_sound("placement")) check_placement(scene.placement, reader, problems);
  if (reader.is_sound("start")) check_start(scene.start, reader, problems);
  check_forces(scene, reader, problems, warnings);
  check_node_count(scene, reader, problems);
  if (reader.is_sound("hydrodynamics")) check_hydrodynamics(scene.hydrodynamics, reader, problems);
  if (!reader.is_sound("time")) return;
  check_time(scene.time, reader, problems);
  check_method(scene, reader, problems);
  if (reader.is_sound("output")) check_frame_count(scene, reader, problems);
}

}  // namespace skein
