#pragma once

#include <skein/physics/physics.hpp>
#include <skein/solvers/right_hand_side.hpp>

#include <cstdint>

namespace skein {

/// How far a power iteration may go: until two estimates agree within `accuracy`, or so many evaluations are spent.
struct PowerIterationLimits {
  double accuracy;
  int max_iterations;
};

/// Good for the choice of a method and for what a run will take: up to an eighth too low.
inline constexpr PowerIterationLimits rough_radius{0.05, 30};

/// Good for saying whether a step is stable.
inline constexpr PowerIterationLimits exact_radius{1e-4, 300};

/// A distance that is small against the spacing of nodes and large against the rounding of positions. Length
double small_displacement(const Physics& physics);

/// The largest |eigenvalue| of d velocity / d position, from below: see SpectralRadius. Not finite where velocities are
/// not. It does not depend on the number of threads. 1 / time
/// @param rhs   of this physics, perhaps decorated
/// @param seed  of the first vector
double find_spectral_radius_at(const Physics& physics, RightHandSide& rhs, double time, const ConstVectors& position,
                               std::uint64_t seed, const PowerIterationLimits& limits);

}  // namespace skein
