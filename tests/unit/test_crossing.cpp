// How often centrelines pass through each other, where it is known, and against the linking number of closed ones.
#include <skein/analysis/crossing.hpp>

#include "tests/support/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>

namespace skein {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<Fiber> make_lines(const std::vector<int>& sections) {
  std::vector<FiberConfig> configs;
  for (const int n : sections) {
    FiberConfig config;
    config.sections = n;
    config.radius = 0.005;
    configs.push_back(config);
  }
  return make_fibers(configs);
}

/// Evenly spaced points of a straight line.
void append_line(std::vector<Vec3>& points, const int n, const Vec3 from, const Vec3 to) {
  for (int i = 0; i < n; ++i) points.push_back(from + (static_cast<double>(i) / (n - 1)) * (to - from));
}

/// Crossings while shape(t) goes from t = 0 to 1 in steps; the same after a random rotation of all of it.
int follow(const std::vector<Fiber>& fibers, const int n_steps, const std::function<std::vector<Vec3>(double)>& shape) {
  reference::Random random(7);
  const test::Rotation turn = test::make_random_rotation(random);
  int n = 0, n_turned = 0;
  for (int step = 0; step < n_steps; ++step) {
    const auto before = shape(static_cast<double>(step) / n_steps), after = shape((step + 1.0) / n_steps);
    n += count_crossings(fibers, before, after);
    n_turned += count_crossings(fibers, turn(before), turn(after));
  }
  EXPECT_EQ(n, n_turned) << "after a rotation, in " << n_steps << " steps";
  return n;
}

TEST(Crossing, OfALinePushedThroughAnotherCountsOnceAndThereAndBackTwice) {
  const auto fibers = make_lines({21, 31});
  // Through the middles, which are joints of pieces, and through places that are not.
  for (const Vec3 place : {Vec3{}, Vec3{0.0013, -0.0021, 0.0}, Vec3{0.0, 0.0021, 0.0}})
    for (const int n_steps : {1, 2, 3, 10, 101}) {
      const auto shape = [&](const double height) {
        std::vector<Vec3> points;
        append_line(points, 21, {-0.1, 0.0, 0.0}, {0.1, 0.0, 0.0});
        append_line(points, 31, place + Vec3{0.0, -0.1, height}, place + Vec3{0.0, 0.1, height});
        return points;
      };
      EXPECT_EQ(follow(fibers, n_steps, [&](const double t) { return shape(0.03 - 0.061 * t); }), 1) << n_steps;
      EXPECT_EQ(follow(fibers, 2 * n_steps, [&](const double t) { return shape(0.031 * std::cos(2.0 * pi * t)); }), 2)
          << n_steps;
    }
}

TEST(Crossing, OfALineThatPassesBesideAnEndIsNone) {
  const auto fibers = make_lines({21, 31});
  for (const int n_steps : {1, 3, 20}) {
    const auto beside = [&](const double x) {
      return follow(fibers, n_steps, [&](const double t) {
        std::vector<Vec3> points;
        append_line(points, 21, {-0.1, 0.0, 0.0}, {0.1, 0.0, 0.0});
        append_line(points, 31, {x, -0.1, 0.05 - 0.12 * t}, {x, 0.1, 0.05 - 0.12 * t});
        return points;
      });
    };
    EXPECT_EQ(beside(0.1001), 0);
    EXPECT_EQ(beside(0.0999), 1);
  }
}

/// A planar fiber folded in two: its halves lie along x, `gap` apart, joined by an arc.
std::vector<Vec3> make_fold(const int n, const double length, const double gap, const double noise) {
  reference::Random random(3);
  std::vector<Vec3> points;
  const double arc = 0.5 * pi * gap, straight = 0.5 * (length - arc);
  for (int i = 0; i < n; ++i) {
    const double s = length * i / (n - 1.0), angle = (s - straight) / (0.5 * gap);
    Vec3 x = s < straight ? Vec3{s, 0.0, 0.0}
             : s < straight + arc
                 ? Vec3{straight + 0.5 * gap * std::sin(angle), 0.5 * gap * (1.0 - std::cos(angle)), 0.0}
                 : Vec3{straight - (s - straight - arc), gap, 0.0};
    x.z = random.uniform(-noise, noise);
    points.push_back(x);
  }
  return points;
}

TEST(Crossing, OfAPlanarFiberFoldedOnItselfWithoutTouchingIsNone) {
  const auto fibers = make_lines({120});
  for (const double noise : {0.0, 1e-17, 1e-9})
    for (const int n_steps : {1, 7, 40})
      EXPECT_EQ(follow(fibers, n_steps, [&](const double t) { return make_fold(120, 0.8, 0.2 - 0.199 * t, noise); }), 0)
          << noise;
}

/// A planar hook: from x = 0 along x, then back, its end turned down to y = `tip`.
std::vector<Vec3> make_hook(const double tip, const double place) {
  std::vector<Vec3> points;
  append_line(points, 60, {0.0, 0.0, 0.0}, {0.3, 0.0, 0.0});
  append_line(points, 20, {0.3, 0.005, 0.0}, {0.3, 0.1, 0.0});
  append_line(points, 30, {0.295, 0.1, 0.0}, {place, 0.1, 0.0});
  append_line(points, 20, {place, 0.095, 0.0}, {place, tip, 0.0});
  return points;
}

TEST(Crossing, OfAPlanarTipThroughASideCountsOnceHoweverItMoves) {
  const auto fibers = make_lines({130});
  for (const int n_steps : {1, 4, 50}) {
    EXPECT_EQ(follow(fibers, n_steps, [](const double t) { return make_hook(0.09 - 0.08 * t, 0.1217); }), 0);
    EXPECT_EQ(follow(fibers, n_steps, [](const double t) { return make_hook(0.09 - 0.14 * t, 0.1217); }), 1);
    // It stays across, moves along the side, and is drawn back.
    EXPECT_EQ(follow(fibers, n_steps, [](const double) { return make_hook(-0.04, 0.1217); }), 0);
    EXPECT_EQ(follow(fibers, n_steps, [](const double t) { return make_hook(-0.04, 0.1217 + 0.09 * t); }), 0);
    EXPECT_EQ(follow(fibers, n_steps, [](const double t) { return make_hook(-0.04 + 0.09 * t, 0.1217); }), 0);
  }
}

TEST(Crossing, OfParallelLinesThatSlideOverEachOtherIsOne) {
  const auto fibers = make_lines({21, 21});
  for (const int n_steps : {1, 2, 9, 10})
    for (const double beside : {0.0, 0.05}) {
      EXPECT_EQ(
          follow(fibers, n_steps,
                 [&](const double t) {
                   std::vector<Vec3> points;
                   append_line(points, 21, {-0.1, 0.0, 0.0}, {0.1, 0.0, 0.0});
                   append_line(points, 21, {beside - 0.1, 0.03 - 0.06 * t, 0.0}, {beside + 0.1, 0.03 - 0.06 * t, 0.0});
                   return points;
                 }),
          1)
          << n_steps << " " << beside;
    }
}

TEST(Crossing, OfAnEndDrawnThroughTheFibersOwnLoopIsOne) {
  const auto fibers = make_lines({180});
  // A ring in the plane z = 0, then an end that stands beside it and is pushed through its side.
  const auto shape = [](const double t) {
    std::vector<Vec3> points;
    for (int i = 0; i < 100; ++i) points.push_back({0.08 * std::cos(0.06 * i), 0.08 * std::sin(0.06 * i), 0.0});
    const double x = 0.12 - 0.08 * t;
    append_line(points, 40, points.back() + Vec3{0.003, 0.0, 0.004}, {x, 0.02, 0.1});
    append_line(points, 40, {x, 0.02, 0.095}, {x, 0.02, -0.1});
    return points;
  };
  for (const int n_steps : {1, 5, 64}) EXPECT_EQ(follow(fibers, n_steps, shape), 1) << n_steps;
}

/// Of two closed polygons, by the signs of the places where they cross when seen along z.
int compute_linking_number(const std::vector<Vec3>& one, const std::vector<Vec3>& other) {
  int sum = 0;
  for (std::size_t i = 0; i + 1 < one.size(); ++i)
    for (std::size_t j = 0; j + 1 < other.size(); ++j) {
      const Vec3 a = one[i], b = other[j], d = one[i + 1] - a, e = other[j + 1] - b, w = b - a;
      const double determinant = d.x * e.y - d.y * e.x;
      const double s = (w.x * e.y - w.y * e.x) / determinant, t = (w.x * d.y - w.y * d.x) / determinant;
      if (s < 0.0 || s >= 1.0 || t < 0.0 || t >= 1.0) continue;
      const bool is_over = a.z + s * d.z > b.z + t * e.z;
      sum += (determinant > 0.0) == is_over ? 1 : -1;
    }
  return sum / 2;
}

std::vector<Vec3> make_random_ring(const int n, reference::Random& random) {
  const Vec3 center = random.in_cube(0.05), wave = random.in_cube(0.04), other_wave = random.in_cube(0.04);
  const test::Rotation turn = test::make_random_rotation(random);
  std::vector<Vec3> ring;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * pi * i / (n - 1.0);
    ring.push_back(center + turn(Vec3{0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.0} +
                                 std::cos(2.0 * angle) * wave + std::sin(3.0 * angle) * other_wave));
  }
  ring.back() = ring.front();
  return ring;
}

// Every passage of two closed lines through each other changes their linking number by one, upwards or downwards.
TEST(Crossing, OfClosedLinesAgreesWithTheirLinkingNumber) {
  constexpr int n = 41, n_steps = 40;
  const auto one = make_lines({n}), both = make_lines({n, n});
  int n_passages = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    reference::Random random(seed);
    const std::vector<Vec3> start[] = {make_random_ring(n, random), make_random_ring(n, random)},
                            end[] = {make_random_ring(n, random), make_random_ring(n, random)};
    const auto ring_at = [&](const int ring, const double t) {
      std::vector<Vec3> points;
      for (int i = 0; i < n; ++i) points.push_back(start[ring][i] + t * (end[ring][i] - start[ring][i]));
      return points;
    };
    // Of both rings, without what each does to itself.
    const auto count = [&](const double t, const double next) {
      auto before = ring_at(0, t), after = ring_at(0, next);
      int n_crossings = -count_crossings(one, before, after);
      const auto other_before = ring_at(1, t), other_after = ring_at(1, next);
      n_crossings -= count_crossings(one, other_before, other_after);
      before.insert(before.end(), other_before.begin(), other_before.end());
      after.insert(after.end(), other_after.begin(), other_after.end());
      return n_crossings + count_crossings(both, before, after);
    };
    int n_counted = 0;
    for (int step = 0; step < n_steps; ++step) {
      const double t = static_cast<double>(step) / n_steps, next = (step + 1.0) / n_steps;
      const int counted = count(t, next);
      const int change = compute_linking_number(ring_at(0, next), ring_at(1, next)) -
                         compute_linking_number(ring_at(0, t), ring_at(1, t));
      EXPECT_GE(counted, std::abs(change)) << seed << " " << step;
      EXPECT_EQ((counted - change) % 2, 0) << seed << " " << step << ": " << counted << ", " << change;
      n_counted += counted;
    }
    // The motion is straight as a whole, too: one long step sees the same, but for places where several follow each
    // other on the same pieces.
    EXPECT_NEAR(count(0.0, 1.0), n_counted, 1) << seed;
    n_passages += n_counted;
  }
  EXPECT_GT(n_passages, 100);
}

}  // namespace
}  // namespace skein
