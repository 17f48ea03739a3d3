#pragma once

#include <skein/core/vec3.hpp>

#include "tests/reference/point_cloud.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace skein::test {

/// A rotation about an axis of length 1.
struct Rotation {
  Vec3 axis;
  double angle = 0.0;

  Vec3 operator()(const Vec3 x) const {
    return std::cos(angle) * x + std::sin(angle) * cross(axis, x) + (1.0 - std::cos(angle)) * dot(axis, x) * axis;
  }
  std::vector<Vec3> operator()(const std::vector<Vec3>& points) const {
    std::vector<Vec3> turned;
    for (const Vec3 x : points) turned.push_back((*this)(x));
    return turned;
  }
};

inline Rotation make_random_rotation(reference::Random& random) {
  return {random.direction(), random.uniform(0.0, 2.0 * std::numbers::pi)};
}

}  // namespace skein::test
