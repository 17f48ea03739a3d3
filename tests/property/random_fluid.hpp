#pragma once

#include "tests/reference/point_cloud.hpp"
#include "tests/reference/regularized_stokeslet_reference.hpp"

#include <rapidcheck.h>

#include <cmath>

namespace skein {

// Random fluids, and what is done to them.

/// A random fluid with random forces in it; no number is 1.
struct Fluid {
  reference::PointForces sources;
  double viscosity = 0.0;
  double size = 0.0;  ///< half extent of the cloud, length
  reference::Random random{0};
};

/// Few, so that mobilities can be kept; none is 1.
inline constexpr int n_viscosities = 4;
inline constexpr double drawn_viscosities[n_viscosities] = {0.02, 0.7, 1.9, 50.0};

/// rapidcheck draws the number of sources and a seed, and shrinks both where a property fails.
inline Fluid draw_fluid(const int most_sources, const bool equal_blobs) {
  const int n_sources = *rc::gen::resize(1000, rc::gen::inRange(1, most_sources + 1)).as("sources");
  const auto seed = *rc::gen::arbitrary<std::uint64_t>().as("seed");
  const reference::Cloud cloud = *rc::gen::elementOf(
      std::vector<reference::Cloud>(std::begin(reference::all_clouds), std::end(reference::all_clouds)));
  RC_LOG() << reference::name_of(cloud) << '\n';
  Fluid fluid;
  fluid.random = reference::Random(seed);
  fluid.viscosity = drawn_viscosities[fluid.random.bits() % n_viscosities];
  fluid.size = fluid.random.log_uniform(0.01, 100.0);
  const double spacing = fluid.size / std::cbrt(n_sources), force = fluid.random.log_uniform(1e-3, 1e3);
  fluid.sources.position =
      reference::make_cloud(cloud, n_sources, fluid.random.in_cube(3.0 * fluid.size), fluid.size, fluid.random);
  fluid.sources.force = reference::make_random_vectors(n_sources, force, fluid.random);
  fluid.sources.blob = reference::make_random_lengths(n_sources, 0.03 * spacing, 0.3 * spacing, fluid.random);
  if (equal_blobs) fluid.sources.blob.assign(fluid.sources.blob.size(), fluid.sources.blob.front());
  return fluid;
}

using reference::norm_of;

/// A rotation by a random angle about a random axis (Rodrigues), and a shift.
struct RigidMotion {
  Vec3 axis, shift;
  double angle;

  explicit RigidMotion(reference::Random& random, const double size)
      : axis(random.direction()), shift(random.in_cube(20.0 * size)), angle(random.uniform(0.3, 6.0)) {}
  Vec3 turn(const Vec3 v) const {
    return std::cos(angle) * v + std::sin(angle) * cross(axis, v) + ((1.0 - std::cos(angle)) * dot(axis, v)) * axis;
  }
  std::vector<Vec3> turn(std::vector<Vec3> list) const {
    for (Vec3& v : list) v = turn(v);
    return list;
  }
  std::vector<Vec3> move(std::vector<Vec3> list) const {
    for (Vec3& v : list) v = turn(v) + shift;
    return list;
  }
};

}  // namespace skein
