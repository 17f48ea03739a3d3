#pragma once

#include <skein/core/vec3.hpp>

#include <array>
#include <span>

namespace skein {

/// The plane from which points are least far away, in the mean square.
struct PlaneFit {
  Vec3 center;                    ///< the points' mean
  Vec3 along, across;             ///< in the plane: where the points spread most, and at right angles to it; length 1
  Vec3 normal;                    ///< length 1; its sign means nothing
  std::array<double, 3> width{};  ///< root of the sum of squares along these three, falling; length
};

/// By the singular values of the points' places about their mean, so that distances from the plane are exact to
/// rounding. Where the points lie on a line, within `straight` of their extent, any plane through it serves: it is then
/// the one whose normal is nearest to `preferred`, unless that is the zero vector.
PlaneFit fit_plane(std::span<const Vec3> points, Vec3 preferred = {});

/// Deviations from a line, over its length, that are taken for rounding.
inline constexpr double straight = 1e-9;

/// Largest distance of points from the plane through their mean with this normal. Length
double find_largest_height(std::span<const Vec3> points, Vec3 normal);

}  // namespace skein
