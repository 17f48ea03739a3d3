#include "tests/reference/gauss_rule.hpp"
#include "tests/unit/stokeslet_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

// What the formula means: numbers that follow from the fluid and the blob, not from another sum.

namespace skein {
namespace {

constexpr double pi = std::numbers::pi;

/// Velocity at `target` due to unit forces along the three axes at the origin: the columns of S.
std::vector<Vec3> compute_columns(const Vec3 target, const double blob) {
  std::vector<Vec3> column;
  for (const Vec3 force : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}})
    column.push_back(
        compute_velocity(Sum::general, Precision::in_double, {{{0.0, 0.0, 0.0}}, {force}, {blob}}, {target}).front());
  return column;
}

TEST(StokesletPhysics, IsIsotropicAtItsOwnPoint) {
  const double blob = 0.37, expected = 1.0 / (4.0 * pi * test_viscosity * blob);
  const auto s = compute_columns({0.0, 0.0, 0.0}, blob);
  EXPECT_NEAR(s[0].x, expected, 1e-14 * expected);
  EXPECT_NEAR(s[1].y, expected, 1e-14 * expected);
  EXPECT_NEAR(s[2].z, expected, 1e-14 * expected);
  for (const double off_diagonal : {s[0].y, s[0].z, s[1].x, s[1].z, s[2].x, s[2].y}) EXPECT_EQ(off_diagonal, 0.0);
}

TEST(StokesletPhysics, TraceDependsOnDistanceAlone) {
  reference::Random random(1);
  const double blob = 0.2;
  for (const double r : {0.01, 0.1, 0.2, 0.5, 3.0, 200.0}) {
    const auto s = compute_columns(r * random.direction(), blob);
    const double core = r * r + blob * blob;
    const double expected = (4.0 * r * r + 6.0 * blob * blob) / (8.0 * pi * test_viscosity * core * std::sqrt(core));
    EXPECT_NEAR(s[0].x + s[1].y + s[2].z, expected, 1e-13 * expected) << r;
    EXPECT_NEAR(s[0].y, s[1].x, 1e-13 * expected) << r;
    EXPECT_NEAR(s[0].z, s[2].x, 1e-13 * expected) << r;
    EXPECT_NEAR(s[1].z, s[2].y, 1e-13 * expected) << r;
  }
}

// The blob weakens the flow ahead of the force and strengthens the flow beside it, both by eps^2 / (2 r^2).
TEST(StokesletPhysics, TurnsIntoAPointForceFarAway) {
  const double blob = 0.4;
  for (const double r : {20.0, 80.0}) {
    const auto s = compute_columns({0.0, r, 0.0}, blob);
    const double point = 1.0 / (8.0 * pi * test_viscosity * r), change = blob * blob / (2.0 * r * r);
    EXPECT_NEAR(s[1].y / (2.0 * point) - 1.0, -change, 0.01 * change);
    EXPECT_NEAR(s[0].x / point - 1.0, change, 0.01 * change);
  }
}

/// 6 pi viscosity a U / F of a sphere of radius a under an even traction, U averaged over its surface: by symmetry the
/// trace at one point over three stands for the average.
double sphere_mobility(const double radius, const double blob, const int n_polar) {
  std::vector<double> cosine, weight;
  reference::make_gauss_rule(n_polar, cosine, weight);
  const int n_around = 2 * n_polar;
  reference::PointForces sources;
  std::vector<double> share;
  for (int i = 0; i < n_polar; ++i)
    for (int j = 0; j < n_around; ++j) {
      const double across = std::sqrt(1.0 - cosine[i] * cosine[i]), angle = 2.0 * pi * j / n_around;
      sources.position.push_back(radius * Vec3{across * std::cos(angle), across * std::sin(angle), cosine[i]});
      share.push_back(weight[i] / (2.0 * n_around));
    }
  sources.blob.assign(share.size(), blob);
  const std::vector<Vec3> target{radius * Vec3{2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0}};
  double trace = 0.0;
  for (const Vec3 axis : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}}) {
    sources.force.clear();
    for (const double s : share) sources.force.push_back(s * axis);
    trace += dot(axis, compute_velocity(Sum::general, Precision::in_double, sources, target).front());
  }
  return 6.0 * pi * test_viscosity * radius * trace / 3.0;
}

// A sphere under an even traction: 1 - eps / (4 a) + O((eps / a)^4) instead of the 1 of a point force.
TEST(StokesletPhysics, SphereUnderEvenTraction) {
  const double radius = 0.6;
  EXPECT_NEAR(sphere_mobility(radius, 0.1 * radius, 120), 0.975001, 1e-6);
  // The integral over the sphere in closed form, for any blob.
  for (const double ratio : {0.1, 0.25, 0.5, 1.0}) {
    const double root = std::sqrt(4.0 + ratio * ratio);
    const double exact = (2.0 * root - ratio - ratio * ratio / root) / 4.0;
    EXPECT_NEAR(sphere_mobility(radius, ratio * radius, 120), exact, 1e-9) << ratio;
  }
}

}  // namespace
}  // namespace skein
