#include "fmm/near_matches.hpp"
#include "fmm/octree.hpp"
#include "tests/reference/point_cloud.hpp"
#include "tests/unit/stokeslet_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein {
namespace {

using reference::Cloud;
using reference::Random;

OctreeRules rules_for(const int leaf_size, const double min_half_width, const int min_sources_for_expansion) {
  OctreeRules rules;
  rules.leaf_size = leaf_size;
  rules.min_half_width = min_half_width;
  rules.min_sources_for_expansion = min_sources_for_expansion;
  return rules;
}

/// The near field of nodes that are sources and targets alike, as add(targets, sources).
template <class Add>
void visit_near_matches(const HostOctree& tree, const Add& add) {
  const NearMatches near = make_near_matches(tree);
  for (const Match& match : near.matches) {
    const IndexRange one = near.tiles[static_cast<std::size_t>(match.one)];
    const IndexRange other = near.tiles[static_cast<std::size_t>(match.other)];
    add(one, other);
    if (match.one != match.other) add(other, one);
  }
  for (int leaf = 0; leaf < tree.n_target_leaves; ++leaf)
    for (const IndexRange& run : near.one_way.of(leaf)) add(tree.target_leaf(leaf).targets, run);
}

/// How many times the lists count each pair of a target and a source; 1 everywhere is right.
std::vector<int> count_pairs(const HostOctree& tree, const int n_targets, const int n_sources,
                             const bool with_matches) {
  std::vector<int> count(static_cast<std::size_t>(n_targets) * static_cast<std::size_t>(n_sources));
  const auto add = [&](const IndexRange targets, const IndexRange sources) {
    for (int t = 0; t < targets.count; ++t)
      for (int s = 0; s < sources.count; ++s)
        ++count[static_cast<std::size_t>(tree.target_order()(targets.first + t)) * static_cast<std::size_t>(n_sources) +
                static_cast<std::size_t>(tree.source_order()(sources.first + s))];
  };
  for (int leaf = 0; leaf < tree.n_target_leaves; ++leaf) {
    const IndexRange targets = tree.target_leaf(leaf).targets;
    if (!with_matches)
      for (const IndexRange& run : tree.near_runs(leaf)) add(targets, run);
    for (const int w : tree.w_list.of(leaf)) add(targets, tree.box(w).sources);
  }
  if (with_matches) visit_near_matches(tree, add);
  for (int b = 0; b < tree.n_boxes(); ++b) {
    for (const FarPair& pair : tree.v_list.of(b)) add(tree.box(b).targets, tree.box(pair.source).sources);
    for (const int x : tree.x_list.of(b)) add(tree.box(b).targets, tree.box(x).sources);
  }
  return count;
}

void expect_ones(const std::vector<int>& count) {
  EXPECT_TRUE(std::all_of(count.begin(), count.end(), [](const int c) { return c == 1; }))
      << *std::min_element(count.begin(), count.end()) << " .. " << *std::max_element(count.begin(), count.end());
}

void expect_every_pair_once(const std::vector<Vec3>& source, const std::vector<Vec3>& target,
                            const OctreeRules& rules) {
  const HostVectors sources = make_host_vectors(source), targets = make_host_vectors(target);
  HostOctree tree;
  tree.build(HostSpace(), sources, targets, rules);
  expect_ones(count_pairs(tree, static_cast<int>(target.size()), static_cast<int>(source.size()), false));
}

/// Sources that are the targets: as any two arrays, and each pair of leaves once.
void expect_every_pair_once(const std::vector<Vec3>& nodes, const OctreeRules& rules) {
  expect_every_pair_once(nodes, nodes, rules);
  const HostVectors array = make_host_vectors(nodes);
  HostOctree tree;
  tree.build(HostSpace(), array, array, rules);
  const int n = static_cast<int>(nodes.size());
  expect_ones(count_pairs(tree, n, n, false));
  expect_ones(count_pairs(tree, n, n, true));
}

TEST(Octree, ListsHoldEveryPairOnce) {
  Random random(11);
  for (const Cloud cloud : reference::all_clouds)
    for (const int leaf_size : {1, 5, 40})
      for (const int min_sources : {0, 8, 1000}) {
        SCOPED_TRACE(reference::name_of(cloud) + " leaves of " + std::to_string(leaf_size));
        const auto source = reference::make_cloud(cloud, 500, {3.0, -1.0, 0.4}, 0.7, random);
        const auto target = reference::make_cloud(Cloud::cluster, 300, {3.1, -1.0, 0.4}, 0.5, random);
        expect_every_pair_once(source, target, rules_for(leaf_size, 0.0, min_sources));
        expect_every_pair_once(source, rules_for(leaf_size, 0.0, min_sources));
      }
}

TEST(Octree, UsesEveryKindOfList) {
  Random random(3);
  auto nodes = reference::make_cloud(Cloud::cluster, 2000, {}, 1.0, random);
  const auto even = reference::make_cloud(Cloud::cube, 1000, {}, 1.0, random);
  nodes.insert(nodes.end(), even.begin(), even.end());
  const HostVectors array = make_host_vectors(nodes);
  HostOctree tree;
  tree.build(HostSpace(), array, array, rules_for(4, 0.0, 0));
  EXPECT_GT(tree.v_list.n_entries, 0);
  EXPECT_GT(tree.w_list.n_entries, 0);
  EXPECT_GT(tree.x_list.n_entries, 0);
  EXPECT_GT(tree.u_list.n_entries, 0);
}

TEST(Octree, AMatchWaitsForTheTurnsBeforeIt) {
  Random random(8);
  const HostVectors nodes = make_host_vectors(reference::make_cloud(Cloud::cluster, 5000, {}, 1.0, random));
  HostOctree tree;
  tree.build(HostSpace(), nodes, nodes, rules_for(20, 0.0, 0));
  const NearMatches near = make_near_matches(tree);
  std::vector<int> n_met(near.tiles.size(), 0);
  for (const Match& match : near.matches) {
    EXPECT_EQ(match.turn_of_one, n_met[static_cast<std::size_t>(match.one)]++);
    if (match.other == match.one) continue;
    EXPECT_EQ(match.turn_of_other, n_met[static_cast<std::size_t>(match.other)]++);
  }
  for (std::size_t tile = 0; tile < near.tiles.size(); ++tile) EXPECT_GT(n_met[tile], 0) << tile;
}

TEST(Octree, BadInputMakesAFiniteTree) {
  const OctreeRules rules = rules_for(2, 0.0, 10);
  expect_every_pair_once(std::vector<Vec3>{}, rules);
  expect_every_pair_once(std::vector<Vec3>{{1.0, 2.0, 3.0}}, rules);
  expect_every_pair_once(std::vector<Vec3>(100, {0.1, 0.2, 0.3}), rules);
  expect_every_pair_once({{1.0, 2.0, 3.0}}, {}, rules);
  expect_every_pair_once(std::vector<Vec3>(100, {0.1, 0.2, 0.3}), std::vector<Vec3>(50, {0.1, 0.2, 0.3}), rules);
  std::vector<Vec3> line, twice;
  for (int i = 0; i < 200; ++i) line.push_back({0.01 * i, 0.0, 0.0});
  for (int i = 0; i < 200; ++i) twice.push_back({std::ldexp(1.0, -(i / 2)), 1.0, 0.0});  // ever closer pairs
  expect_every_pair_once(line, rules);
  expect_every_pair_once(twice, rules);
  std::vector<Vec3> far = line;
  far.push_back({1e12, -1e12, 1e12});
  expect_every_pair_once(far, line, rules);
  far.push_back({std::numeric_limits<double>::quiet_NaN(), 0.0, std::numeric_limits<double>::infinity()});
  expect_every_pair_once(far, line, rules);
  expect_every_pair_once(far, rules);
}

TEST(Octree, NoLeafIsSmallerThanAllowed) {
  Random random(5);
  for (const Cloud cloud : reference::all_clouds)
    for (const double min_half_width : {0.5, 0.21}) {
      const HostVectors nodes = make_host_vectors(reference::make_cloud(cloud, 2000, {1.0, 0.0, 0.0}, 1.0, random));
      HostOctree tree;
      tree.build(HostSpace(), nodes, nodes, rules_for(1, min_half_width, 0));
      EXPECT_GE(tree.half_width(tree.n_levels() - 1), min_half_width * (1.0 - 1e-12));
      // ... and crowded leaves go as far down as they may.
      EXPECT_LT(tree.half_width(tree.n_levels() - 1), 2.0 * min_half_width) << reference::name_of(cloud);
    }
}

TEST(Octree, NodesLieInTheirBoxes) {
  Random random(6);
  const auto nodes = reference::make_cloud(Cloud::cluster, 3000, {0.2, 5.0, -1.0}, 0.3, random);
  const HostVectors array = make_host_vectors(nodes);
  HostOctree tree;
  tree.build(HostSpace(), array, array, rules_for(7, 0.0, 0));
  for (int b = 0; b < tree.n_boxes(); ++b) {
    const Box& box = tree.box(b);
    const Vec3 center = tree.cube.center(box);
    const double reach = tree.half_width(box.level) * (1.0 + 1e-9);
    for (int i = 0; i < box.sources.count; ++i) {
      const Vec3 d = nodes[static_cast<std::size_t>(tree.source_order()(box.sources.first + i))] - center;
      EXPECT_LE(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}), reach);
    }
  }
}

TEST(Octree, AStraightFiberLiesInOneRowOfCells) {
  std::vector<Vec3> nodes;
  for (int s = 0; s < 500; ++s)
    for (int a = 0; a < 18; ++a)
      nodes.push_back({0.00173648 * s, 0.005 * std::cos(a * 0.349066), 0.005 * std::sin(a * 0.349066)});
  const HostVectors array = make_host_vectors(nodes);
  HostOctree tree;
  tree.build(HostSpace(), array, array, rules_for(60, 0.0073, 0));
  const skein::IndexRange leaves = tree.level(tree.n_levels() - 1);
  for (int b = leaves.first; b < leaves.first + leaves.count; ++b)
    for (int c = 1; c < 3; ++c) EXPECT_EQ(tree.box(b).cell[c], tree.box(leaves.first).cell[c]);
  for (int leaf = 0; leaf < tree.n_target_leaves; ++leaf) EXPECT_EQ(tree.near_runs(leaf).size(), 1u);  // of neighbours
}

}  // namespace
}  // namespace skein
