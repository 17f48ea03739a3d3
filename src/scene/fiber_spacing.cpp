#include <skein/scene/fiber_spacing.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein {

double compute_node_spacing(const FiberConfig& fiber) {
  return 2.0 * fiber.radius * std::sin(std::numbers::pi / fiber.nodes_per_section);
}

double compute_section_spacing(const FiberConfig& fiber) {
  return fiber.spacing > 0.0 ? fiber.spacing : compute_node_spacing(fiber);
}

FiberConfig lay_out_chain(const FiberConfig& fiber) {
  if (!fiber.stands_for_tube()) return fiber;
  constexpr double radii_apart = 2.0;         // closer nodes cost more, and change half periods by less than a percent
  constexpr double fewest = 3.0, most = 1e9;  // three have one bend
  const double length = fiber.sections * compute_section_spacing(fiber);
  FiberConfig chain = fiber;
  chain.sections = fiber.chain_nodes > 0
                       ? fiber.chain_nodes
                       : static_cast<int>(std::clamp(std::round(length / (radii_apart * fiber.radius)), fewest, most));
  chain.spacing = length / chain.sections;
  chain.nodes_per_section = 1;
  chain.chain_nodes = 0;
  chain.stiffness_within_sections = chain.stiffness_between_sections = 1.0;
  chain.reach_along = 1;
  chain.reach_around = 0;
  return chain;
}

SceneConfig lay_out_chains(SceneConfig scene) {
  for (FiberConfig& fiber : scene.fibers) fiber = lay_out_chain(fiber);
  return scene;
}

}  // namespace skein
