// Tubes with flat ends: whether they overlap, against points of one that lie inside the other.
#include <skein/fibers/placement.hpp>
#include <skein/fibers/tube_overlap.hpp>

#include "tests/reference/point_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace skein {
namespace {

TubePiece make_tube(const Vec3 first, const Vec3 last, const double radius) {
  const FiberAxes axes = make_fiber_axes(last - first, 0.0);
  return {{first, axes}, {last, axes}, radius};
}

bool contains(const TubePiece& tube, const Vec3 point) {
  const Vec3 d = point - tube.first.center, along = tube.first.axes.along;
  const double place = dot(d, along);
  return place >= 0.0 && place <= norm(tube.last.center - tube.first.center) && norm(d - place * along) <= tube.radius;
}

bool has_point_inside(const TubePiece& tube, const TubePiece& other) {
  constexpr int n = 24;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n / 2; ++j)
      for (int k = 0; k < n; ++k) {
        const double out = tube.radius * j / (n / 2), angle = 6.283185307179586 * k / n;
        const Vec3 point = tube.first.center + i / double(n) * (tube.last.center - tube.first.center) +
                           out * std::cos(angle) * tube.first.axes.angle_0 +
                           out * std::sin(angle) * tube.first.axes.angle_90;
        if (contains(other, point)) return true;
      }
  return false;
}

TEST(TubeOverlap, IsThatOfTheirPoints) {
  reference::Random random(5);
  int n_apart = 0, n_close = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Vec3 a = random.in_cube(0.6), b = random.in_cube(0.6);
    const TubePiece one = make_tube(a, a + random.uniform(0.2, 1.5) * random.direction(), random.uniform(0.05, 0.5));
    const TubePiece other = make_tube(b, b + random.uniform(0.2, 1.5) * random.direction(), random.uniform(0.05, 0.5));
    const bool is_apart = are_apart(one, other);
    EXPECT_EQ(is_apart, are_apart(other, one));
    n_apart += is_apart;
    const bool is_inside = has_point_inside(one, other) || has_point_inside(other, one);
    if (is_inside) {
      EXPECT_FALSE(is_apart) << trial;
    } else if (!is_apart) {
      ++n_close;  // between the sampled points, or shallow
    }
  }
  EXPECT_GT(n_apart, 100);
  EXPECT_GT(400 - n_apart, 60);
  EXPECT_LT(n_close, 10);
}

TEST(TubeOverlap, FlatEndsEndWhereTheyEnd) {
  const TubePiece tube = make_tube({0, 0, 0}, {1, 0, 0}, 0.1);
  for (const double gap : {1e-7, 0.05, 0.15}) {
    EXPECT_TRUE(are_apart(tube, make_tube({1 + gap, 0, 0}, {2, 0, 0}, 0.1))) << gap;        // end to end
    EXPECT_TRUE(are_apart(tube, make_tube({1 + gap, 0.07, 0}, {2, 0.07, 0}, 0.3))) << gap;  // beside the axis
    EXPECT_TRUE(are_apart(tube, make_tube({1.1 + gap, -1, 0}, {1.1 + gap, 1, 0}, 0.1)));    // a T
    EXPECT_TRUE(are_apart(tube, make_tube({0, 0.2 + gap, 0}, {1, 0.2 + gap, 0}, 0.1)));     // side by side
  }
  for (const double depth : {1e-7, 0.05}) {
    EXPECT_FALSE(are_apart(tube, make_tube({1 - depth, 0, 0}, {2, 0, 0}, 0.1)));
    EXPECT_FALSE(are_apart(tube, make_tube({1.1 - depth, -1, 0}, {1.1 - depth, 1, 0}, 0.1)));
    EXPECT_FALSE(are_apart(tube, make_tube({0, 0.2 - depth, 0}, {1, 0.2 - depth, 0}, 0.1)));
  }
  EXPECT_FALSE(are_apart(tube, tube));
  EXPECT_FALSE(are_apart(tube, make_tube({0.4, 0, 0}, {0.6, 0, 0}, 0.05)));  // one inside the other
}

TEST(TubeOverlap, FibersEndToEndAreAccepted) {
  FiberConfig first;
  first.sections = 28;
  first.nodes_per_section = 6;  // a spacing of 0.005: centreline 0.135 long
  first.direction = {1, 2, -2};
  FiberConfig second = first;
  const auto place = [&](const double apart) { second.center = apart / 3.0 * Vec3{1, 2, -2}; };
  const auto n_overlaps = [&] { return find_overlap_problems({}, make_fibers({first, second})).size(); };
  place(0.14);
  EXPECT_EQ(n_overlaps(), 0u);
  place(0.1351);
  EXPECT_EQ(n_overlaps(), 0u);
  place(0.1349);
  EXPECT_EQ(n_overlaps(), 1u);
  // Bent ones are judged piece by piece.
  first.start_amplitude = second.start_amplitude = 0.01;
  place(0.14);
  EXPECT_EQ(n_overlaps(), 0u);
  place(0.13);
  EXPECT_EQ(n_overlaps(), 1u);
}

}  // namespace
}  // namespace skein
