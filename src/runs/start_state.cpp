#include "runs/start_state.hpp"

#include <skein/core/error.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/io/start_file.hpp>

#include <fmt/format.h>

namespace skein {
namespace {

/// The state of a fiber that was elastic is no start of one that is rigid now.
void check_straight(const Physics& physics, const std::vector<Vec3>& position) {
  constexpr double largest_bend = 1e-4;  // of the length
  if (physics.rigid_bodies.is_empty()) return;
  const Vectors places = to_device("skein::make_start_state::places", position);
  const RigidPoses poses = physics.rigid_bodies.make_poses();
  physics.rigid_bodies.compute_poses(places, poses);
  physics.rigid_bodies.place(poses, places);
  const std::vector<Vec3> straight = to_host(ConstVectors(places));
  for (const Fiber& fiber : physics.fibers)
    for (int node = fiber.first_node; node < fiber.first_node + fiber.n_nodes(); ++node)
      if (const double off = norm(straight[node] - position[node]); off > largest_bend * fiber.length())
        throw Error(ExitCode::scene_error,
                    fmt::format("fiber {} is rigid, and in the state that the run begins with it is bent, by {:.3g} at "
                                "node {}: begin with a straight fiber, or take model = \"chain\"",
                                fiber.index, off, node - fiber.first_node));
}

}  // namespace

State make_start_state(const SceneConfig& scene, const RunFolder& folder, const bool is_resumed,
                       const Physics& physics) {
  const bool as_written = scene.start.checksum.empty() || is_resumed;
  const std::vector<Vec3> position =
      as_written ? make_surface_nodes(physics.fibers, scene.seed) : read_start(folder.start(), scene);
  if (!as_written) check_straight(physics, position);
  return {scene.time.start, 0, to_device("skein::make_start_state::position", position)};
}

}  // namespace skein
