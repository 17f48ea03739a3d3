#include <skein/analysis/centreline.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

std::vector<Vec3> make_helix(const int n, const double radius, const double pitch, const double step) {
  std::vector<Vec3> point;
  for (int i = 0; i < n; ++i)
    point.push_back({2.0 + radius * std::cos(step * i), radius * std::sin(step * i), pitch * step * i});
  return point;
}

TEST(Curvature, OfACircleIsExact) {
  for (const int reach : {1, 2, 5})
    for (const double radius : {0.3, 70.0})
      for (const double kappa : compute_curvature(make_helix(30, radius, 0.0, 0.1), reach))
        EXPECT_NEAR(kappa, 1.0 / radius, 1e-10 / radius);
}

// kappa = r / (r^2 + p^2), approached with the square of the section's spacing.
TEST(Curvature, OfAHelixIsApproached) {
  const double radius = 0.4, pitch = 0.15, exact = radius / (radius * radius + pitch * pitch);
  double error[2];
  for (const int halving : {0, 1}) {
    const auto curvature = compute_curvature(make_helix(21, radius, pitch, 0.1 / (1 << halving)), 2);
    error[halving] = std::abs(curvature[10] / exact - 1.0);
  }
  EXPECT_LT(error[0], 5e-3);
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.1);
}

TEST(Curvature, UsesWhatThereIsNearTheEnds) {
  // A corner at section 3 of 8: seen by sections whose reach it is strictly inside of, and by none else.
  std::vector<Vec3> line;
  for (int s = 0; s < 8; ++s) line.push_back(s <= 3 ? Vec3{0.2 * s, 0.0, 0.0} : Vec3{0.6, 0.2 * (s - 3), 0.0});
  const auto curvature = compute_curvature(line, 2);
  ASSERT_EQ(curvature.size(), 8u);
  const auto is_bent = [&](const int s) { return curvature[s] > 1e-12; };
  EXPECT_FALSE(is_bent(1));  // reach 1: sections 0, 1, 2
  EXPECT_TRUE(is_bent(2));   // reach 2: sections 0, 2, 4
  EXPECT_TRUE(is_bent(3));
  EXPECT_TRUE(is_bent(4));   // sections 2, 4, 6
  EXPECT_FALSE(is_bent(5));  // sections 3, 5, 7
  EXPECT_FALSE(is_bent(6));
  EXPECT_EQ(curvature[0], curvature[1]);
  EXPECT_EQ(curvature[7], curvature[6]);
  EXPECT_NEAR(curvature[3], 1.0 / (0.4 / std::numbers::sqrt2), 1e-12);  // hypotenuse 0.4 sqrt(2) is the diameter
}

TEST(Curvature, OfTwoSectionsIsZeroAndOfPointsThatMeetFinite) {
  const std::vector<Vec3> two{{0.1, 0.2, 0.3}, {0.5, 0.2, 0.3}};
  EXPECT_EQ(compute_curvature(two), std::vector<double>(2, 0.0));
  const std::vector<Vec3> heap(6, Vec3{0.1, 0.2, 0.3});
  for (const double kappa : compute_curvature(heap)) EXPECT_EQ(kappa, 0.0);
}

TEST(Centreline, LengthAndEndToEnd) {
  const std::vector<Vec3> line{{1.0, 2.0, 3.0}, {1.0, 2.3, 3.4}, {0.8, 2.3, 3.4}, {0.8, 2.3, 3.1}};
  EXPECT_NEAR(compute_length(line), 0.5 + 0.2 + 0.3, 1e-15);
  EXPECT_LT(norm(compute_end_to_end(line) - Vec3{-0.2, 0.3, 0.1}), 1e-15);
}

}  // namespace
}  // namespace skein
