#pragma once

#include <skein/core/vec3.hpp>

#include <array>
#include <span>

namespace skein {

/// A symmetric second-order tensor: xx, yy, zz, yz, xz, xy.
using SymmetricTensor = std::array<double, 6>;

/// The symmetric part of the first moment of forces about the mean of their positions, sum of (x - mean) f.
/// @param position, force  [n], as many of one as of the other
SymmetricTensor compute_symmetric_moment(std::span<const Vec3> position, std::span<const Vec3> force);

}  // namespace skein
