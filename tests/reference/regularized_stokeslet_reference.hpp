#pragma once

#include <skein/core/vec3.hpp>

#include <vector>

namespace skein::reference {

/// Forces on the fluid at points, each with its own blob.
struct PointForces {
  std::vector<Vec3> position;  ///< length
  std::vector<Vec3> force;
  std::vector<double> blob;  ///< regularization length, > 0
};

/// Velocity at the targets, summed pair by pair in long double by the textbook formula. @returns [n_targets]
std::vector<Vec3> compute_stokeslet_velocity(const PointForces& sources, const std::vector<Vec3>& target,
                                             double viscosity);

/// Largest |actual - expected| over the largest |expected|; 0 for two empty lists, NaN where either has a NaN.
double relative_error(const std::vector<Vec3>& actual, const std::vector<Vec3>& expected);

/// sum_i a_i . b_i
double inner_product(const std::vector<Vec3>& a, const std::vector<Vec3>& b);

/// sqrt(sum_i v_i . v_i)
double norm_of(const std::vector<Vec3>& v);

/// x + h v, row by row.
std::vector<Vec3> shifted(const std::vector<Vec3>& x, double h, const std::vector<Vec3>& v);

}  // namespace skein::reference
