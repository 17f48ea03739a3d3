#include "runs/start_state.hpp"

#include <skein/fibers/fiber.hpp>
#include <skein/io/start_file.hpp>

namespace skein {

State make_start_state(const SceneConfig& scene, const RunFolder& folder, const bool is_resumed,
                       const Physics& physics) {
  const bool as_written = scene.start.checksum.empty() || is_resumed;
  std::vector<Vec3> position = as_written ? physics.make_start_nodes(scene.seed) : read_start(folder.path(), scene);
  if (physics.symmetry != nullptr) make_symmetric(physics.symmetry->orbits(), physics.fibers, position);
  return {scene.time.start, 0, to_device("skein::make_start_state::position", position)};
}

}  // namespace skein
