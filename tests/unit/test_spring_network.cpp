#include <skein/core/error.hpp>
#include <skein/fibers/spring_network.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace skein {
namespace {

std::vector<Fiber> one_fiber(const int sections, const int nodes_per_section) {
  FiberConfig config;
  config.sections = sections;
  config.nodes_per_section = nodes_per_section;
  return make_fibers({config});
}

TEST(SpringNetwork, CountIs477TimesSectionsLess324) {
  for (const int sections : {2, 3, 80, 113, 1313})
    EXPECT_EQ(count_springs(one_fiber(sections, 18)), 477 * sections - 324);
}

TEST(SpringNetwork, CountsOfOtherSections) {
  // n(n-1)/2 inside a section, n^2 between two.
  for (const int n : {3, 4, 7}) EXPECT_EQ(count_springs(one_fiber(5, n)), 5 * n * (n - 1) / 2 + 4 * n * n);
}

TEST(SpringNetwork, ReachSetsTheCount) {
  FiberConfig config;
  config.sections = 9;
  config.nodes_per_section = 8;
  config.reach_along = 3;
  EXPECT_EQ(count_springs(make_fibers({config})), 9 * 28 + (8 + 7 + 6) * 64);
  config.reach_around = 2;  // 4 neighbours inside a section, 5 on another
  EXPECT_EQ(count_springs(make_fibers({config})), 9 * 16 + (8 + 7 + 6) * 8 * 5);
  config.reach_around = 4;  // the opposite node counts once
  EXPECT_EQ(count_springs(make_fibers({config})), 9 * 28 + (8 + 7 + 6) * 64);
  config.reach_along = 8;
  config.sections = 3;  // fewer than the reach
  EXPECT_EQ(count_springs(make_fibers({config})), 3 * 28 + 3 * 64);
}

TEST(SpringNetwork, InnerNodesHave53SpringsAndEndNodes35) {
  std::vector<int> springs_of(6 * 18, 0);
  for (const auto& [node, other] : make_spring_list(one_fiber(6, 18))) {
    ++springs_of[node];
    ++springs_of[other];
  }
  for (int node = 0; node < 6 * 18; ++node) {
    const int section = node / 18;
    EXPECT_EQ(springs_of[node], section == 0 || section == 5 ? 35 : 53) << node;
  }
}

TEST(SpringNetwork, EverySpringIsListedOnceAndStaysInItsFiber) {
  FiberConfig small, other;
  small.sections = 4;
  small.nodes_per_section = 5;
  other.sections = 3;
  other.nodes_per_section = 4;
  const auto springs = make_spring_list(make_fibers({small, other}));

  EXPECT_EQ(static_cast<std::int64_t>(springs.size()), count_springs(make_fibers({small, other})));
  EXPECT_EQ(springs.size(), 4 * 10 + 3 * 25 + 3 * 6 + 2 * 16u);
  std::set<std::pair<int, int>> seen;
  for (const auto& [node, partner] : springs) {
    EXPECT_TRUE(seen.insert(std::minmax(node, partner)).second) << node << ' ' << partner;
    EXPECT_EQ(node < 20, partner < 20);
    EXPECT_LT(std::max(node, partner), 32);
  }
}

TEST(SpringNetwork, RestLengthsAreTheDistancesOfTheStraightFiber) {
  for (const int n : {3, 4, 7, 18}) {
    FiberConfig config;
    config.sections = 4;
    config.nodes_per_section = n;
    config.direction = {1.0, -0.4, 2.0};
    const auto fibers = make_fibers({config});
    const auto nodes = make_surface_nodes(fibers);
    const auto network = make_spring_network(fibers[0]);
    for_each_spring(network, [&](const int node, const int other, const int entry) {
      EXPECT_NEAR(network.stencil.rest_length[entry], norm(nodes[node] - nodes[other]), 1e-12 * config.radius);
      EXPECT_EQ(network.stencil.stiffness[entry], 0.0112);
    });
    EXPECT_LT(compute_spring_energy(network, nodes), 1e-30);
  }
}

TEST(SpringNetwork, LengthsOfThePaper) {
  const RestLengths found = find_rest_lengths(make_spring_network(one_fiber(80, 18)[0]).stencil);
  EXPECT_NEAR(found.shortest, 0.00173648178, 1e-11);
  EXPECT_NEAR(found.longest, 0.0101496, 5e-8);
}

TEST(SpringNetwork, BothNamesOfASpringInsideASectionAgreeToTheLastBit) {
  for (const int n : {3, 4, 7, 18}) {
    const SpringStencil stencil = make_spring_network(one_fiber(2, n)[0]).stencil;
    for (int d = 1; d < n; ++d)
      EXPECT_EQ(stencil.rest_length[stencil.entry(0, d)], stencil.rest_length[stencil.entry(0, n - d)]);
  }
}

TEST(SpringNetwork, StiffnessZeroMeansNoSpring) {
  SpringNetwork network = make_spring_network(one_fiber(3, 5)[0]);
  network.stencil.stiffness[network.stencil.entry(1, 2)] = 0.0;
  EXPECT_EQ(count_springs(network), 3 * 10 + 2 * 20);
}

TEST(SpringNetwork, EnergyOfOneStretchedSpring) {
  // Three nodes on a section, all other springs cut: k l (r/l - 1)^2 / 2 with r = 1.5 l.
  SpringNetwork network = make_spring_network(one_fiber(2, 3)[0]);
  network.stencil.stiffness.assign(6, 0.0);
  network.stencil.stiffness[network.stencil.entry(1, 0)] = 0.7;
  network.stencil.rest_length[network.stencil.entry(1, 0)] = 0.4;
  std::vector<Vec3> position = {{0, 0, 0}, {5, 0, 0}, {7, 0, 0}, {0, 0.6, 0}, {5, 0.4, 0}, {7, 0, 0.4}};

  EXPECT_NEAR(compute_spring_energy(network, position), 0.5 * 0.7 * 0.4 * 0.25, 1e-16);
  position.pop_back();
  EXPECT_THROW(compute_spring_energy(network, position), Error);
}

}  // namespace
}  // namespace skein
