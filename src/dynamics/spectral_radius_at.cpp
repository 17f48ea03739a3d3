#include <skein/dynamics/spectral_radius_at.hpp>
#include <skein/solvers/spectral_radius.hpp>

#include <algorithm>

namespace skein {

double small_displacement(const Physics& physics) {
  double spacing = physics.fibers.front().spacing();
  for (const Fiber& fiber : physics.fibers) spacing = std::min(spacing, fiber.spacing());
  return 1e-5 * spacing;
}

double find_spectral_radius_at(const Physics& physics, RightHandSide& rhs, const double time,
                               const ConstVectors& position, const std::uint64_t seed,
                               const PowerIterationLimits& limits) {
  const Vectors velocity("skein::find_spectral_radius_at::velocity", position.extent(0));
  rhs.compute_velocity(time, position, velocity);
  SpectralRadius power_iteration(position.extent_int(0), small_displacement(physics), seed);
  return power_iteration.estimate(rhs, time, position, velocity, limits.accuracy, limits.max_iterations);
}

}  // namespace skein
