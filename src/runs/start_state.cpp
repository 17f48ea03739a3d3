#include "runs/start_state.hpp"

#include <skein/fibers/fiber.hpp>
#include <skein/io/start_file.hpp>

namespace skein {

State make_start_state(const SceneConfig& scene, const RunFolder& folder, const bool is_resumed,
                       const Physics& physics) {
  const bool as_written = scene.start.checksum.empty() || is_resumed;
  const std::vector<Vec3> position =
      as_written ? make_surface_nodes(physics.fibers, scene.seed) : read_start(folder.start(), scene);
  return {scene.time.start, 0, to_device("skein::make_start_state::position", position)};
}

}  // namespace skein
