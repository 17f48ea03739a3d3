#include <skein/core/error.hpp>
#include <skein/fibers/fiber.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

FiberConfig small_fiber() {
  FiberConfig config;
  config.sections = 5;
  config.nodes_per_section = 7;
  config.radius = 0.3;
  config.blob = 0.11;
  return config;
}

std::vector<Vec3> nodes_of(const FiberConfig& config) { return make_surface_nodes(make_fibers({config})); }

std::vector<Vec3> nodes_along(const Vec3 direction) {
  FiberConfig config = small_fiber();
  config.direction = direction;
  return nodes_of(config);
}

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = a.size() == b.size() ? 0.0 : INFINITY;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) largest = std::max(largest, norm(a[i] - b[i]));
  return largest;
}

TEST(Fiber, LengthsAreThoseOfThePaper) {
  FiberConfig config;
  const std::vector<std::pair<int, double>> lengths = {
      {80, 0.138919}, {113, 0.196222}, {301, 0.522681}, {536, 0.930754}, {1313, 2.28}};
  for (const auto& [sections, length] : lengths) {
    config.sections = sections;
    EXPECT_NEAR(make_fibers({config})[0].length(), length, length * 5e-6) << sections;
  }
}

TEST(Fiber, SpacingIsTheChordBetweenNeighboursOnASection) {
  const auto nodes = nodes_of(small_fiber());
  const double spacing = make_fibers({small_fiber()})[0].spacing();

  EXPECT_NEAR(spacing, norm(nodes[1] - nodes[0]), 1e-15);
  EXPECT_NEAR(spacing, norm(nodes[7] - nodes[0]), 1e-15);
}

TEST(Fiber, FibersFollowEachOtherWithoutGaps) {
  FiberConfig other = small_fiber();
  other.sections = 3;
  other.nodes_per_section = 4;
  other.blob = 0.2;
  const auto fibers = make_fibers({small_fiber(), other});

  EXPECT_EQ(fibers[1].first_node, 35);
  EXPECT_EQ(fibers[1].first_section, 5);
  EXPECT_EQ(count_nodes(fibers), 47);
  EXPECT_EQ(count_sections(fibers), 8);
  EXPECT_EQ(make_surface_nodes(fibers).size(), 47u);
  const auto blobs = make_blobs(fibers);
  ASSERT_EQ(blobs.size(), 47u);
  EXPECT_EQ(blobs[34], 0.11);
  EXPECT_EQ(blobs[35], 0.2);
}

TEST(Fiber, NodesOfAFiberAlongXStandAtTheirAngles) {
  FiberConfig config = small_fiber();
  config.center = {1.0, -2.0, 0.5};
  const auto nodes = nodes_of(config);
  const double spacing = make_fibers({config})[0].spacing();

  for (int section = 0; section < 5; ++section) {
    for (int a = 0; a < 7; ++a) {
      const double angle = 2.0 * std::numbers::pi * a / 7;
      const Vec3 expected{1.0 + (section - 2) * spacing, -2.0 + 0.3 * std::cos(angle), 0.5 + 0.3 * std::sin(angle)};
      EXPECT_LT(norm(nodes[section * 7 + a] - expected), 1e-15) << section << ' ' << a;
    }
  }
}

TEST(Fiber, RollTurnsAngleZeroFromYTowardsZ) {
  FiberConfig config = small_fiber();
  config.roll = 30.0;
  const Vec3 first = nodes_of(config)[0];

  EXPECT_NEAR(first.y, 0.3 * std::cos(std::numbers::pi / 6), 1e-15);
  EXPECT_NEAR(first.z, 0.3 * 0.5, 1e-15);
}

TEST(Fiber, AnyDirectionIsARotationOfTheFiberAlongX) {
  const auto reference = nodes_along({1, 0, 0});
  const std::vector<Vec3> directions = {{2, 0, 0},      {0, 3, 0},         {0, 0, -0.1},     {-1, 0, 0},    {1, 2, -3},
                                        {-1, 0.5, 0.2}, {-1, 1e-9, -2e-9}, {-1, -1e-160, 0}, {-5, 1e-17, 0}};
  for (const Vec3 direction : directions) {
    const auto nodes = nodes_along(direction);
    const Vec3 along = direction / norm(direction);
    EXPECT_LT(norm(nodes[7] - nodes[0] - norm(reference[7] - reference[0]) * along), 1e-14);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        ASSERT_NEAR(norm(nodes[i] - nodes[j]), norm(reference[i] - reference[j]), 1e-14)
            << direction.x << ' ' << direction.y << ' ' << direction.z;
    // Not a mirror image: the angle grows from y to z about x.
    const Vec3 middle = 0.5 * (nodes[0] + nodes[28]);
    const double turned = dot(cross(nodes[14] - nodes[21], nodes[15] - nodes[21]), along);
    const double reference_turned = dot(cross(reference[14] - reference[21], reference[15] - reference[21]), {1, 0, 0});
    EXPECT_NEAR(turned, reference_turned, 1e-14) << middle.x;
  }
}

TEST(Fiber, AxesAreContinuousInTheDirection) {
  constexpr double turn = 1e-6;
  constexpr double reach = 1.5;  // more than twice the fiber's half length and radius: rolls count as well
  for (double polar = 0.1; polar < 3.0; polar += 0.3) {
    for (double around = 0.0; around < 6.2; around += 0.5) {
      const auto along = [&](const double p, const double t) {
        return nodes_along({std::cos(p), std::sin(p) * std::cos(t), std::sin(p) * std::sin(t)});
      };
      // Near -x a turn about x rolls the fiber by twice the turn.
      EXPECT_LT(largest_distance(along(polar, around), along(polar + turn, around)), 3 * reach * turn);
      EXPECT_LT(largest_distance(along(polar, around), along(polar, around + turn)), 3 * reach * turn);
    }
  }
  EXPECT_LT(largest_distance(nodes_along({-1, 0, 0}), nodes_along({-1, turn, 0})), 3 * reach * turn);
  EXPECT_LT(largest_distance(nodes_along({-1, 0, 0}), nodes_along({-1, -turn, 0})), 3 * reach * turn);
}

TEST(Fiber, ImpossibleFibersAreRefused) {
  const auto refused = [](const auto& change) {
    FiberConfig config = small_fiber();
    change(config);
    EXPECT_THROW(make_fibers({config}), Error);
  };
  refused([](FiberConfig& c) { c.sections = 1; });
  refused([](FiberConfig& c) { c.nodes_per_section = 2; });
  refused([](FiberConfig& c) { c.radius = 0.0; });
  refused([](FiberConfig& c) { c.direction = {0, 0, 0}; });
}

}  // namespace
}  // namespace skein
