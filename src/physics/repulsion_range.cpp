#include <skein/physics/repulsion_range.hpp>

#include <algorithm>
#include <limits>

namespace skein {

double find_repulsion_range(const RepulsionConfig& config, const std::vector<Fiber>& fibers) {
  if (config.range > 0.0) return config.range;
  double thinnest = std::numeric_limits<double>::infinity();
  for (const Fiber& fiber : fibers) thinnest = std::min(thinnest, fiber.config.radius);
  return thinnest;
}

}  // namespace skein
