#pragma once

#include <skein/core/math.hpp>
#include <skein/core/simd.hpp>

#include "kernels/inverse_sqrt.hpp"

#include <numbers>
#include <type_traits>

namespace skein {

/// Velocity of the fluid due to a force spread over the blob phi = 15 eps^4 / (8 pi (r^2 + eps^2)^(7/2)):
///
///   8 pi viscosity u = [ (r^2 + 2 eps^2) f + (f . d) d ] / (r^2 + eps^2)^(3/2),   d = target - source
///
/// At r = 0: u = f / (4 pi viscosity eps). Source: Cortez, Fauci, Medovikov, Phys. Fluids 17, 031504 (2005).
namespace regularized_stokeslet {

inline constexpr int flops_per_pair = 32;  ///< an inverse square root counted as one

/// The factor 1 / (8 pi viscosity), applied to the forces once instead of to every pair.
inline double scale(const double viscosity) { return 1.0 / (8.0 * std::numbers::pi * viscosity); }

/// (r^2 + eps^2)^(-3/2) and (r^2 + 2 eps^2) (r^2 + eps^2)^(-3/2) of one pair: symmetric in source and target.
template <class Lanes>
struct Weights {
  Lanes along;
  Lanes isotropic;
};

/// Lanes is a number, or a CPU vector with one target in each lane; BlobSquared may be a number for all lanes.
template <class Lanes, class BlobSquared>
SKEIN_FORMULA Weights<Lanes> weights(const Lanes dx, const Lanes dy, const Lanes dz, const BlobSquared blob_squared) {
  const Lanes core_squared = dx * dx + (dy * dy + (dz * dz + blob_squared));
  if constexpr (std::is_floating_point_v<Lanes>) {
    const Lanes inverse = math::inverse_sqrt_of_normal(core_squared);
    const Lanes along = inverse * inverse * inverse;
    return {along, blob_squared * along + inverse};
  } else {
    const Lanes along = simd::inverse_sqrt_cubed(core_squared);
    return {along, along * (core_squared + blob_squared)};
  }
}

/// u += 8 pi viscosity times the velocity due to the force f.
template <class Lanes, class Force>
SKEIN_FORMULA void add(const Weights<Lanes> weight, const Lanes dx, const Lanes dy, const Lanes dz, const Force fx,
                       const Force fy, const Force fz, Lanes& ux, Lanes& uy, Lanes& uz) {
  const Lanes along = weight.along * (fx * dx + fy * dy + fz * dz);
  // Two fused operations each; as one sum, the compiler makes three of it.
  ux += weight.isotropic * fx;
  uy += weight.isotropic * fy;
  uz += weight.isotropic * fz;
  ux += along * dx;
  uy += along * dy;
  uz += along * dz;
}

}  // namespace regularized_stokeslet
}  // namespace skein
