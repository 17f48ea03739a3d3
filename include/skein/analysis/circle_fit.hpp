#pragma once

#include <skein/core/vec3.hpp>

#include <span>

namespace skein {

struct Circle {
  Vec3 center;
  double radius = 0.0;
  Vec3 normal;       ///< of its plane
  double rms = 0.0;  ///< distance of the points from the circle's line within the plane, length
};

/// The circle with the least squares of distances: in the points' plane of least squares, begun with the algebraic
/// circle and refined by Gauss and Newton. Radius infinity for points on a line or fewer than three points.
Circle fit_circle(std::span<const Vec3> points);

}  // namespace skein
