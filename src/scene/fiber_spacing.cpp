#include <skein/scene/fiber_spacing.hpp>

#include <cmath>
#include <numbers>

namespace skein {

double compute_node_spacing(const FiberConfig& fiber) {
  return 2.0 * fiber.radius * std::sin(std::numbers::pi / fiber.nodes_per_section);
}

double compute_section_spacing(const FiberConfig& fiber) {
  return fiber.spacing > 0.0 ? fiber.spacing : compute_node_spacing(fiber);
}

}  // namespace skein
