// Centroids, faults and gaps of all fibers' sections, against loops over all of them.
#include <skein/physics/sections.hpp>

#include "tests/reference/point_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace skein {
namespace {

std::vector<Fiber> make_test_fibers(const std::vector<int>& sections, const double radius = 0.04) {
  std::vector<FiberConfig> configs;
  for (std::size_t f = 0; f < sections.size(); ++f) {
    FiberConfig config;
    config.sections = sections[f];
    config.nodes_per_section = 6 + static_cast<int>(f);
    config.radius = radius * (1.0 + 0.3 * static_cast<double>(f));
    configs.push_back(config);
  }
  return make_fibers(configs);
}

std::vector<Vec3> make_helix(const int n, const double radius, const double pitch, const double step) {
  std::vector<Vec3> point;
  for (int i = 0; i < n; ++i)
    point.push_back({2.0 + radius * std::cos(step * i), radius * std::sin(step * i), pitch * step * i});
  return point;
}

TEST(Sections, HaveCentroidsThatAreTheMeansOfTheirNodes) {
  const auto fibers = make_test_fibers({5, 2, 33});
  reference::Random random(4);
  const auto position = reference::make_random_vectors(count_nodes(fibers), 2.0, random);
  const auto centreline = Sections(fibers).compute_centreline(to_device("position", position));
  ASSERT_EQ(centreline.size(), 40u);
  EXPECT_EQ(Sections(fibers).look(to_device("position", position)).centreline, centreline);
  std::size_t node = 0, section = 0;
  for (const Fiber& fiber : fibers)
    for (int s = 0; s < fiber.config.sections; ++s, ++section) {
      Vec3 sum;
      for (int a = 0; a < fiber.config.nodes_per_section; ++a) sum = sum + position[node++];
      EXPECT_LT(norm(centreline[section] - sum / fiber.config.nodes_per_section), 1e-15) << section;
    }
}

/// The gap of sections whose nodes all lie about given centroids, however it is asked for.
double gap_of(const std::vector<Fiber>& fibers, const std::vector<Vec3>& centreline) {
  std::vector<Vec3> position;
  for (const Fiber& fiber : fibers)
    for (int s = 0; s < fiber.config.sections; ++s)
      position.insert(position.end(), fiber.config.nodes_per_section, centreline[fiber.first_section + s]);
  const Vectors on_device = to_device("position", position);
  const double gap = Sections(fibers).compute_smallest_gap(on_device);
  EXPECT_EQ(Sections(fibers).look(on_device).smallest_gap, gap);
  return gap;
}

/// Every pair of sections of different fibers, and of one fiber where at least ten radii of it lie between them.
double smallest_gap_of_all_pairs(const std::vector<Fiber>& fibers, const std::vector<Vec3>& centreline) {
  double gap = std::numeric_limits<double>::infinity();
  for (const Fiber& one : fibers)
    for (const Fiber& other : fibers)
      for (int s = 0; s < one.config.sections; ++s)
        for (int t = 0; t < other.config.sections; ++t) {
          const bool same = one.first_node == other.first_node;
          if (same && std::abs(t - s) * one.spacing() < 10.0 * one.config.radius) continue;
          gap = std::min(gap, norm(centreline[one.first_section + s] - centreline[other.first_section + t]) -
                                  one.config.radius - other.config.radius);
        }
  return gap;
}

TEST(SmallestGap, AgreesWithAllPairsOnRandomCurves) {
  int n_overlapping = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    reference::Random random(seed);
    std::vector<int> sections;
    for (int f = 0; f < 1 + static_cast<int>(seed % 4); ++f)
      sections.push_back(2 + static_cast<int>(random.bits() % 90));
    const auto fibers = make_test_fibers(sections, 0.004);
    std::vector<Vec3> centreline;
    for (const Fiber& fiber : fibers) {
      // A walk that keeps its direction for a while, with segments stretched and squeezed.
      Vec3 point = random.in_cube(0.1), direction = random.direction();
      for (int s = 0; s < fiber.config.sections; ++s) {
        centreline.push_back(point);
        direction = direction + 0.5 * random.direction();
        direction = direction / norm(direction);
        point = point + (fiber.spacing() * random.uniform(0.2, 2.0)) * direction;
      }
    }
    const double gap = gap_of(fibers, centreline);
    n_overlapping += gap < 0.0;
    const double expected = smallest_gap_of_all_pairs(fibers, centreline);
    EXPECT_TRUE(gap == expected || std::abs(gap - expected) < 1e-15) << "seed " << seed << ": " << gap - expected;
  }
  EXPECT_GT(n_overlapping, 5);
  EXPECT_LT(n_overlapping, 55);
}

TEST(SmallestGap, OfACoilIsItsPitch) {
  const auto fibers = make_test_fibers({300}, 0.004);
  const double rise = 0.02;
  const auto coil = make_helix(300, 0.1, rise / (2.0 * std::numbers::pi), 2.0 * std::numbers::pi / 40.0);
  EXPECT_NEAR(gap_of(fibers, coil), rise - 2.0 * 0.004, 1e-12);
}

TEST(SmallestGap, IsInfiniteWithoutDistantSections) {
  const auto fibers = make_test_fibers({8});
  EXPECT_EQ(gap_of(fibers, make_helix(8, 0.3, 0.1, 0.1)), std::numeric_limits<double>::infinity());
}

TEST(SmallestGap, OfCoincidentFibersIsTheSumOfTheirRadii) {
  const auto fibers = make_test_fibers({4, 4});
  auto centreline = make_helix(4, 5.0, 0.1, 0.2);
  centreline.insert(centreline.end(), centreline.begin(), centreline.end());
  EXPECT_NEAR(gap_of(fibers, centreline), -(fibers[0].config.radius + fibers[1].config.radius), 1e-15);
}

}  // namespace
}  // namespace skein
