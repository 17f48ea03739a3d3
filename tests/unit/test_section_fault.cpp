#include <skein/physics/sections.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

constexpr double radius = 0.13;
constexpr double max_ratio = 4.0;
constexpr int n_sections = 40;
constexpr int nodes_per_section = 9;
constexpr int first_node = 24;  // of the tube: nodes of other fibers lie before and after it
constexpr int last_node = first_node + n_sections * nodes_per_section - 1;
/// A tube of rings, and sound sections of the other fibers far away.
std::vector<Vec3> make_tube() {
  std::vector<Vec3> position(last_node + 1 + first_node, Vec3{1e5, -1e5, 3e4});
  for (int s = 0; s < n_sections; ++s)
    for (int a = 0; a < nodes_per_section; ++a) {
      const double angle = 2.0 * std::numbers::pi * a / nodes_per_section;
      position[first_node + s * nodes_per_section + a] =
          Vec3{7.0 + 0.1 * s, radius * std::cos(angle) - 3.0, radius * std::sin(angle)};
    }
  return position;
}

/// Three fibers, of which the tube is the second; the others are small.
std::vector<Fiber> make_three_fibers() {
  FiberConfig small, tube;
  small.sections = 4, small.nodes_per_section = 6, small.radius = 0.02;
  tube.sections = n_sections, tube.nodes_per_section = nodes_per_section, tube.radius = radius;
  return make_fibers({small, tube, small});
}

int find(const std::vector<Vec3>& position) {
  return Sections(make_three_fibers()).find_faulty_node(to_device("position", position), max_ratio);
}

TEST(FindFaultyNode, FindsNothingInASoundFiber) { EXPECT_EQ(find(make_tube()), -1); }

TEST(FindFaultyNode, NamesTheNodeThatIsNotFinite) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e200})
    for (const int node : {first_node, first_node + 5, first_node + 8, first_node + 9, 200, last_node})
      for (const auto component : {&Vec3::x, &Vec3::y, &Vec3::z}) {
        auto position = make_tube();
        position[node].*component = bad;
        EXPECT_EQ(find(position), node) << bad;
      }
}

TEST(FindFaultyNode, NamesTheFirstOfSeveral) {
  auto position = make_tube();
  for (const int node : {300, 101, 250, 107}) position[node].y = std::nan("");
  EXPECT_EQ(find(position), 101);
}

// Moving one node of n by d moves the centroid by d / n: its distance grows by d (1 - 1/n) only.
TEST(FindFaultyNode, AllowsDistancesUpToTheRatio) {
  for (const int node : {first_node, 133, last_node}) {
    const double share = 1.0 - 1.0 / nodes_per_section;
    for (const double off : {-1e-6, 1e-6}) {
      auto position = make_tube();
      // Along the fiber: the distance is sqrt(R^2 + (share d)^2), with R about the shifted centroid to first order.
      const double along = std::sqrt(max_ratio * max_ratio - 1.0) * radius / share;
      position[node].x += along * (1.0 + off);
      EXPECT_EQ(find(position), off < 0.0 ? -1 : node);
    }
  }
}

TEST(FindFaultyNode, DoesNotMindWhereTheFiberIs) {
  auto position = make_tube();
  for (Vec3& x : position) x = x + Vec3{2e6, -3e7, 1e6};
  EXPECT_EQ(find(position), -1);
}

TEST(FindFaultyNode, NamesTheFirstOfAllFibers) {
  auto position = make_tube();
  position[last_node + 1].y = std::nan("");
  EXPECT_EQ(find(position), last_node + 1);
  position[first_node + 100].x = HUGE_VAL;
  EXPECT_EQ(find(position), first_node + 100);
  // Each fiber's own radius counts: what the tube allows bursts a small one.
  position[3].x += 3.0 * radius;
  EXPECT_EQ(find(position), 3);
}

}  // namespace
}  // namespace skein
