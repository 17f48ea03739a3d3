#pragma once

#include <skein/arrays/sources.hpp>

#include "tests/reference/point_cloud.hpp"
#include "tests/reference/regularized_stokeslet_reference.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

// Tubes, spirals and forces on them, for what compares the fast multipole method with direct sums.

namespace skein {

inline constexpr double viscosity = 0.7;
inline constexpr double radius = 0.005, spacing = 0.00173648, fiber_blob = 0.00225;

inline Sources on_device(const reference::PointForces& from) {
  return {to_device("position", from.position), to_device("force", from.force), to_device("blob", from.blob)};
}

/// Relative error, 2-norm over all targets: what the tolerance bounds.
inline double error_of(const std::vector<Vec3>& got, const std::vector<Vec3>& exact) {
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    difference += dot(got[i] - exact[i], got[i] - exact[i]);
    size += dot(exact[i], exact[i]);
  }
  return std::sqrt(difference / size);
}

inline void add_section(std::vector<Vec3>& nodes, const Vec3 center, const Vec3 one, const Vec3 other) {
  for (int a = 0; a < 18; ++a) {
    const double angle = 2.0 * std::numbers::pi * a / 18;
    nodes.push_back(center + radius * std::cos(angle) * one + radius * std::sin(angle) * other);
  }
}
inline std::vector<Vec3> make_tube(const int sections) {
  std::vector<Vec3> nodes;
  for (int s = 0; s < sections; ++s) add_section(nodes, {s * spacing, 0.0, 0.0}, {0, 1, 0}, {0, 0, 1});
  return nodes;
}
inline std::vector<Vec3> make_spiral(const int sections) {
  constexpr double growth = 0.03 / (2.0 * std::numbers::pi);
  std::vector<Vec3> nodes;
  double angle = 2.0 * std::numbers::pi;
  for (int s = 0; s < sections; ++s) {
    const double r = growth * angle;
    const Vec3 along{growth * std::cos(angle) - r * std::sin(angle), growth * std::sin(angle) + r * std::cos(angle),
                     0.0};
    add_section(nodes, {r * std::cos(angle), r * std::sin(angle), 0.0}, Vec3{-along.y, along.x, 0.0} / norm(along),
                {0, 0, 1});
    angle += spacing / norm(along);
  }
  return nodes;
}

inline reference::PointForces with_forces(const std::vector<Vec3>& nodes, const double blob, const std::uint64_t seed) {
  reference::Random random(seed);
  return {nodes, reference::make_random_vectors(static_cast<int>(nodes.size()), 1.3, random),
          std::vector<double>(nodes.size(), blob)};
}

/// The nearest well-separated boxes: sources fill one, targets the next but one.
struct NearestBoxes {
  static constexpr double half_width = 0.37;
  reference::PointForces from;
  std::vector<Vec3> target;

  /// @param pin  of the nodes in the far corners, which pin the boxes, in half-widths from a box's centre
  NearestBoxes(const double blob_over_half_width, const std::uint64_t seed, const double pin = 1.0) {
    reference::Random random(seed);
    for (int i = 0; i < 200; ++i) {
      from.position.push_back(half_width * random.in_cube(0.9999));
      target.push_back(half_width * (Vec3{4.0, 0.0, 0.0} + random.in_cube(0.9999)));
      from.force.push_back(Vec3{1.0, 0.5, -0.7} + random.in_cube(1.0));
      from.blob.push_back(blob_over_half_width * half_width);
    }
    from.position[0] = half_width * Vec3{-pin, -0.9999, -0.9999};
    target[0] = half_width * Vec3{4.0 + pin, 0.9999, 0.9999};
  }
};

}  // namespace skein
