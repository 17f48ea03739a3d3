#include "scene_numbers.hpp"

#include <skein/core/error.hpp>
#include <skein/scene/scene_size.hpp>

#include <algorithm>
#include <cmath>

namespace skein {

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

double count_copies(const SceneConfig& scene, const std::size_t fiber) {
  const auto n_fibers = static_cast<double>(scene.fibers.size());
  return std::max(0.0, std::ceil((count_fibers(scene) - static_cast<double>(fiber)) / n_fibers));
}

double count_scene_nodes(const SceneConfig& scene) {
  double n_nodes = 0.0;
  for (std::size_t f = 0; f < scene.fibers.size(); ++f)
    n_nodes += count_copies(scene, f) * scene.fibers[f].sections * scene.fibers[f].nodes_per_section;
  return n_nodes;
}

}  // namespace skein
