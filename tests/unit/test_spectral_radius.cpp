#include <skein/solvers/spectral_radius.hpp>

#include "tests/unit/pointwise_right_hand_side.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skein {
namespace {

constexpr int n_nodes = 20;
constexpr double largest = 8.3e3;

/// 60 rates from 1 to `largest`, evenly on a logarithmic scale; the largest belongs to component z of node 13.
double rate_of(const int component) {
  const int rank = (component + 60 - 3 * 13 - 3) % 60;
  return std::pow(largest, rank / 59.0);
}

double estimate(SpectralRadius& radius, RightHandSide& rhs, const double accuracy, const int max_iterations) {
  const Vectors position = to_device("test::position", std::vector<Vec3>(n_nodes, Vec3{0.3, -2.0, 1.1}));
  const Vectors velocity("test::velocity", n_nodes);
  rhs.compute_velocity(0.7, position, velocity);
  return radius.estimate(rhs, 0.7, position, velocity, accuracy, max_iterations);
}

TEST(SpectralRadius, IsFoundWithinOnePercent) {
  for (const std::uint64_t seed : {1u, 2u, 77u}) {
    auto decay = make_decay(rate_of);
    SpectralRadius radius(n_nodes, 1e-5, seed);
    const double found = estimate(radius, decay, 1e-4, 200);
    EXPECT_NEAR(found, largest, 0.01 * largest);
    EXPECT_LE(found, largest * (1.0 + 1e-6));  // from below
    EXPECT_LT(decay.evaluations(), 150);
  }
}

TEST(SpectralRadius, SignDoesNotMatter) {
  auto growth =
      make_decay([](const int component) { return component % 2 == 0 ? -rate_of(component) : rate_of(component); });
  SpectralRadius radius(n_nodes, 1e-5, 3);
  EXPECT_NEAR(estimate(radius, growth, 1e-4, 200), largest, 0.01 * largest);
}

TEST(SpectralRadius, VectorIsTheModeThatItBelongsTo) {
  auto decay = make_decay(rate_of);
  SpectralRadius radius(n_nodes, 1e-5, 1);
  estimate(radius, decay, 1e-9, 400);
  const auto vector = to_host(ConstVectors(radius.vector()));
  double sum = 0.0;
  for (const Vec3 v : vector) sum += dot(v, v);
  EXPECT_NEAR(std::sqrt(sum / n_nodes), 1.0, 1e-12);
  EXPECT_GT(std::abs(vector[13].z), 0.999 * std::sqrt(static_cast<double>(n_nodes)));
}

TEST(SpectralRadius, NextEstimateStartsFromTheVectorOfTheLast) {
  auto decay = make_decay(rate_of);
  SpectralRadius radius(n_nodes, 1e-5, 1);
  estimate(radius, decay, 1e-6, 400);
  const auto before = decay.evaluations();
  EXPECT_NEAR(estimate(radius, decay, 1e-3, 400), largest, 1e-3 * largest);
  EXPECT_LE(decay.evaluations() - before, 3);  // the velocity at the position, and two iterates that agree
}

TEST(SpectralRadius, SpendsNoMoreThanItMay) {
  auto decay = make_decay(rate_of);
  SpectralRadius radius(n_nodes, 1e-5, 1);
  estimate(radius, decay, 0.0, 7);
  EXPECT_EQ(decay.evaluations(), 8);
}

TEST(SpectralRadius, DoesNotMindWhatDoesNotDependOnPositions) {
  PointwiseRightHandSide wind([](const double time, const int node, Vec3) {
    return Vec3{3.0 + time, 0.1 * node, -2.0};
  });
  SpectralRadius radius(n_nodes, 1e-5, 1);
  EXPECT_LT(estimate(radius, wind, 1e-3, 50), 1e-8);  // rounding of the differences
  auto decay = make_decay(rate_of);
  PointwiseRightHandSide both([&](const double time, const int node, const Vec3 x) {
    return Vec3{40.0 * std::sin(time), 0.0, 7.0} -
           Vec3{rate_of(3 * node) * x.x, rate_of(3 * node + 1) * x.y, rate_of(3 * node + 2) * x.z};
  });
  SpectralRadius again(n_nodes, 1e-5, 1);
  EXPECT_NEAR(estimate(again, both, 1e-4, 200), largest, 0.01 * largest);
}

// Velocities that are not finite, or do not change at all, say nothing; the vector is kept for the next estimate.
TEST(SpectralRadius, OutlivesEquationsWithoutOne) {
  PointwiseRightHandSide broken([](double, int, Vec3) { return Vec3{0.0, std::nan(""), 0.0}; });
  PointwiseRightHandSide rest([](double, int, Vec3) { return Vec3{}; });
  auto decay = make_decay(rate_of);
  SpectralRadius radius(n_nodes, 1e-5, 1);
  EXPECT_FALSE(std::isfinite(estimate(radius, broken, 1e-3, 50)));
  EXPECT_EQ(estimate(radius, rest, 1e-3, 50), 0.0);
  EXPECT_NEAR(estimate(radius, decay, 1e-4, 200), largest, 0.01 * largest);
}

}  // namespace
}  // namespace skein
