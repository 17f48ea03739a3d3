#include "scene_numbers.hpp"

#include <skein/core/error.hpp>

#include <cmath>
#include <numbers>

namespace skein {

double compute_node_spacing(const FiberConfig& fiber) {
  return 2.0 * fiber.radius * std::sin(std::numbers::pi / fiber.nodes_per_section);
}

double count_fibers(const SceneConfig& scene) {
  const PlacementConfig& placement = scene.placement;
  switch (placement.kind) {
    case PlacementKind::as_written:
      return static_cast<double>(scene.fibers.size());
    case PlacementKind::grid:
      return placement.grid.x * placement.grid.y * placement.grid.z;
    case PlacementKind::random:
      return placement.count;
  }
  throw Error(ExitCode::internal, "count_fibers knows no such kind of placement");
}

}  // namespace skein
