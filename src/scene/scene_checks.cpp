#include "scene_checks.hpp"

#include <skein/core/error.hpp>
#include <skein/scene/fiber_spacing.hpp>
#include <skein/scene/scene_size.hpp>

#include "scene_numbers.hpp"
#include "scene_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace skein {
namespace {

constexpr double n_nodes_allowed = 1e8;
constexpr double n_copies_allowed = 1e4;
constexpr double n_frames_allowed = 1e7;
constexpr double n_steps_allowed = 1e12;
constexpr double least_duration = 1e-6;  // over the start: less leaves too few digits for steps and frames

/// A rigid fiber's resistance is two matrices, [n_nodes, n_nodes].
constexpr int n_rigid_nodes_allowed = 2000;

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
               fmt::format("{}.sections {}: a rigid fiber of this length would have {} nodes, and {} is the most: set "
                           "chain_nodes, or take model = \"chain\"",
                           path, fiber.sections, n_nodes, n_rigid_nodes_allowed));
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

void check_profile(const std::vector<ProfilePoint>& profile, const std::string& path, const SceneReader& reader,
                   std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const bool is_ordered = i == 0 || profile[i].position > profile[i - 1].position;
    if (is_ordered && profile[i].position <= 1.0 && profile[i].factor >= 1e-6) continue;
    reader.add(problems, path,
               fmt::format("{}: pair {} is [{}, {}]; positions grow from 0 to 1, factors are above 0", path, i,
                           format_number(profile[i].position), format_number(profile[i].factor)));
    return;
  }
}

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

}  // namespace

void check_scene(const SceneConfig& scene, const SceneReader& reader, std::vector<Problem>& problems,
                 std::vector<Problem>& warnings) {
  for (std::size_t i = 0; i < scene.fibers.size(); ++i) {
    const std::string path = reader.path_of("fiber", i);
    if (!reader.is_sound(path)) continue;
    check_model(scene.fibers[i], path, reader, problems);
    check_fiber(scene.fibers[i], path, reader, problems, warnings);
    check_profile(scene.fibers[i].stiffness_profile, path + ".stiffness_profile", reader, problems);
  }
  for (std::size_t i = 0; i < scene.flows.size(); ++i) {
    const std::string path = reader.path_of("flow", i);
    if (reader.is_sound(path)) check_flow(scene.flows[i], path, reader, problems);
  }
  if (reader.is_sound("placement")) check_placement(scene.placement, reader, problems);
  check_forces(scene, reader, problems, warnings);
  check_node_count(scene, reader, problems);
  if (reader.is_sound("hydrodynamics")) check_hydrodynamics(scene.hydrodynamics, reader, problems);
  if (!reader.is_sound("time")) return;
  check_time(scene.time, reader, problems);
  check_method(scene, reader, problems);
  if (reader.is_sound("output")) check_frame_count(scene, reader, problems);
}

}  // namespace skein
