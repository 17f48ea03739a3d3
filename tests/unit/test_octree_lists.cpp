#include "fmm/octree.hpp"
#include "tests/reference/plain_octree.hpp"
#include "tests/reference/point_cloud.hpp"
#include "tests/unit/stokeslet_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

// The tree and its lists, made by kernels in the execution space, against a tree by the definitions.

namespace skein {
namespace {

using reference::Cloud;
using reference::PlainOctree;
using reference::Random;

template <class View>
auto read_list(const View& device, const int n) {
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), device);
  return std::vector<typename View::non_const_value_type>(host.data(), host.data() + n);
}

/// To the first entries of an array.
template <class Entry>
void write_list(const Kokkos::View<Entry*, ExecSpace>& device, const std::vector<Entry>& list) {
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), device);
  std::copy(list.begin(), list.end(), host.data());
  Kokkos::deep_copy(device, host);
}

std::vector<int> sorted(std::vector<int> list) {
  std::sort(list.begin(), list.end());
  return list;
}

/// Lists as the host reads them.
template <class Entry>
struct ReadLists {
  std::vector<Entry> entries;
  std::vector<int> first;
  ReadLists(const Lists<Entry, ExecSpace>& lists, const int n)
      : entries(read_list(lists.entries, lists.n_entries)), first(read_list(lists.first, n + 1)) {}
  std::vector<Entry> of(const int i) const {
    return {entries.begin() + first[static_cast<std::size_t>(i)],
            entries.begin() + first[static_cast<std::size_t>(i) + 1]};
  }
};

class TreeCheck {
 public:
  /// Trees whose counts are looked at one by one, as on hosts, or together, as on devices.
  explicit TreeCheck(const bool defers_counts) { tree_.defers_counts = defers_counts; }

  void check(const std::vector<Vec3>& source, const std::vector<Vec3>& target, const OctreeRules& rules) {
    tree_.build(ExecSpace(), to_device("source", source), to_device("target", target), rules);
    expect_right(source, target);
  }
  void check(const std::vector<Vec3>& nodes, const OctreeRules& rules) {
    const Vectors on_device = to_device("nodes", nodes);
    tree_.build(ExecSpace(), on_device, on_device, rules);
    expect_right(nodes, nodes);
  }

 private:
  void expect_right(const std::vector<Vec3>& source, const std::vector<Vec3>& target) {
    const PlainOctree plain(tree_.cube, source, target);
    ASSERT_EQ(tree_.n_boxes(), static_cast<int>(plain.boxes.size()));
    const auto boxes = read_list(tree_.boxes, tree_.n_boxes());
    const auto sources = read_list(tree_.source_order(), tree_.n_sources);
    const auto targets = read_list(tree_.target_order(), tree_.n_targets);
    for (int b = 0; b < tree_.n_boxes(); ++b) {
      const Box& box = boxes[static_cast<std::size_t>(b)];
      const auto& wanted = plain.boxes[static_cast<std::size_t>(b)];
      ASSERT_EQ(box.level, wanted.level) << b;
      ASSERT_EQ(box.parent, wanted.parent) << b;
      ASSERT_EQ(box.octant, wanted.octant) << b;
      ASSERT_TRUE(std::equal(box.cell, box.cell + 3, wanted.cell)) << b;
      ASSERT_EQ(box.n_children, static_cast<int>(wanted.children.size())) << b;
      if (!box.is_leaf()) {
        ASSERT_EQ(box.first_child, wanted.children.front()) << b;
      }
      ASSERT_EQ(sorted(nodes_of(box.sources, sources)), wanted.sources) << b;
      ASSERT_EQ(sorted(nodes_of(box.targets, targets)), wanted.targets) << b;
      ASSERT_TRUE(b >= tree_.level(box.level).first && b < tree_.level(box.level).first + tree_.level(box.level).count);
    }
    expect_right_lists(plain, boxes, sources);
  }

  void expect_right_lists(const PlainOctree& plain, const std::vector<Box>& boxes, const std::vector<int>& sources) {
    const int fewest = tree_.rules.min_sources_for_expansion;
    const ReadLists<FarPair> far(tree_.v_list, tree_.n_boxes());
    const ReadLists<int> coarse(tree_.x_list, tree_.n_boxes());
    std::uint64_t met = 0;
    for (int b = 0; b < tree_.n_boxes(); ++b) {
      std::vector<int> found;
      for (const FarPair& pair : far.of(b)) {
        const Box& from = boxes[static_cast<std::size_t>(pair.source)];
        ASSERT_EQ(pair.target, b);
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(pair.transfer[c], from.cell[c] - boxes[static_cast<std::size_t>(b)].cell[c]);
        met |= std::uint64_t{1} << transfer_index(pair.transfer);
        found.push_back(pair.source);
      }
      ASSERT_EQ(sorted(found), plain.far(b)) << "V of " << b;
      ASSERT_EQ(sorted(coarse.of(b)), plain.coarse(b, fewest)) << "X of " << b;
    }
    EXPECT_EQ(tree_.transfers_met(), met);
    const ReadLists<int> fine(tree_.w_list, tree_.n_target_leaves);
    const ReadLists<IndexRange> near(tree_.u_list, tree_.n_target_leaves);
    const auto near_end = read_list(tree_.near_end, tree_.n_target_leaves);
    const auto leaves = read_list(tree_.target_leaves, tree_.n_target_leaves);
    double n_near_pairs = 0.0, largest = 0.0;
    std::vector<int> all_leaves;
    for (int b = 0; b < tree_.n_boxes(); ++b)
      if (plain.boxes[static_cast<std::size_t>(b)].is_leaf() &&
          !plain.boxes[static_cast<std::size_t>(b)].targets.empty())
        all_leaves.push_back(b);
    ASSERT_EQ(leaves, all_leaves);
    for (int leaf = 0; leaf < tree_.n_target_leaves; ++leaf) {
      const int b = leaves[static_cast<std::size_t>(leaf)];
      ASSERT_EQ(sorted(fine.of(leaf)), plain.fine(b, fewest)) << "W of " << b;
      std::vector<int> found, wanted;
      int last = -1;
      for (int k = near.first[static_cast<std::size_t>(leaf)]; k < near_end[static_cast<std::size_t>(leaf)]; ++k) {
        const IndexRange run = near.entries[static_cast<std::size_t>(k)];
        ASSERT_GT(run.first, last) << "runs ascend and those that meet are one";
        last = run.first + run.count;
        const auto nodes = nodes_of(run, sources);
        found.insert(found.end(), nodes.begin(), nodes.end());
      }
      for (const int u : plain.one_by_one(b, fewest)) {
        const auto& nodes = plain.boxes[static_cast<std::size_t>(u)].sources;
        wanted.insert(wanted.end(), nodes.begin(), nodes.end());
      }
      ASSERT_EQ(sorted(found), sorted(wanted)) << "U of " << b;
      const Box& box = boxes[static_cast<std::size_t>(b)];
      n_near_pairs += static_cast<double>(wanted.size()) * box.targets.count;
      largest = std::max(largest, tree_.half_width(box.level));
    }
    EXPECT_EQ(tree_.n_near_pairs, n_near_pairs);
    EXPECT_EQ(tree_.largest_leaf, largest);
  }

  static std::vector<int> nodes_of(const IndexRange run, const std::vector<int>& order) {
    return {order.begin() + run.first, order.begin() + run.first + run.count};
  }

  Octree<ExecSpace> tree_;  ///< in used memory from the second time on
};

OctreeRules rules_for(const int leaf_size, const int min_sources_for_expansion, const double min_half_width = 0.0) {
  OctreeRules rules;
  rules.leaf_size = leaf_size;
  rules.min_sources_for_expansion = min_sources_for_expansion;
  rules.min_half_width = min_half_width;
  return rules;
}

std::vector<Vec3> make_spiral(const int n) {
  std::vector<Vec3> nodes;
  for (int i = 0; i < n; ++i) {
    const double angle = 6.0 * std::numbers::pi * i / n + 1.0, around = 2.0 * std::numbers::pi * (i % 18) / 18;
    const double r = 0.03 * angle + 0.005 * std::cos(around);
    nodes.push_back({r * std::cos(angle), r * std::sin(angle), 0.005 * std::sin(around)});
  }
  return nodes;
}

/// Sorts in memory that was used before.
class KeySort : public testing::Test {
 protected:
  void check(const int n, const int n_bits) {
    std::vector<std::uint64_t> key;
    std::vector<int> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    const std::vector<int> unsorted = order;
    for (int i = 0; i < n; ++i)  // every key several times, so that a sort that is not stable shows
      key.push_back((random_.bits() % static_cast<std::uint64_t>(n / 3 + 1) << (n_bits > 17 ? n_bits - 17 : 0)) &
                    ((std::uint64_t{1} << n_bits) - 1));
    const auto key_of = [&](const int i) { return key[static_cast<std::size_t>(i)]; };
    std::stable_sort(order.begin(), order.end(), [&](const int a, const int b) { return key_of(a) < key_of(b); });
    for (const int few : {0, 1000}) {  // digit by digit, and by comparisons
      keyed_.require(static_cast<std::size_t>(n));
      write_list(keyed_.key, key);
      write_list(keyed_.order, unsorted);
      sort_by_key(ExecSpace(), keyed_, n, n_bits, memory_, few);
      SCOPED_TRACE(std::to_string(n) + " keys of " + std::to_string(n_bits) + " bits, " + std::to_string(few));
      ASSERT_EQ(read_list(keyed_.order, n), order);
      const auto sorted_key = read_list(keyed_.key, n);
      for (int i = 0; i < n; ++i)
        ASSERT_EQ(sorted_key[static_cast<std::size_t>(i)], key_of(order[static_cast<std::size_t>(i)]));
    }
  }

 private:
  Random random_{9};
  SortSpace<ExecSpace> memory_;
  KeyedOrder<ExecSpace> keyed_;
};

TEST_F(KeySort, IsStableAndLooksAtTheLowBits) {
  for (const int n : {1, 2, 31, 32, 33, 1000, 5})
    for (const int n_bits : {3, 15, 60}) check(n, n_bits);
}

TEST_F(KeySort, IsStableForManyKeys) {
  for (const int n : {70000, 5})
    for (const int n_bits : {3, 15, 60}) check(n, n_bits);
}

/// Whether counts are deferred.
class OctreeLists : public testing::TestWithParam<bool> {};

TEST_P(OctreeLists, AreThoseOfTheDefinitions) {
  Random random(11);
  TreeCheck trees(GetParam());
  for (const Cloud cloud : reference::all_clouds)
    for (const int leaf_size : {1, 6, 40})
      for (const int min_sources : {0, 9, 1000}) {
        SCOPED_TRACE(reference::name_of(cloud) + " leaves of " + std::to_string(leaf_size) + ", expansions from " +
                     std::to_string(min_sources));
        const int n = leaf_size == 1 ? 150 : 700;
        const auto source = reference::make_cloud(cloud, n, {3.0, -1.0, 0.4}, 0.7, random);
        const auto target = reference::make_cloud(Cloud::cluster, n / 2, {3.1, -1.0, 0.4}, 0.5, random);
        trees.check(source, target, rules_for(leaf_size, min_sources));
        trees.check(target, source, rules_for(leaf_size, min_sources, 0.02));
        trees.check(source, rules_for(leaf_size, min_sources));
      }
}

TEST_P(OctreeLists, AreRightForManyNodes) {
  Random random(12);
  TreeCheck trees(GetParam());
  trees.check(reference::make_cloud(Cloud::cube, 40000, {}, 1.0, random), rules_for(50, 56));
  OctreeRules quantized = rules_for(30, 20);
  quantized.has_quantized_cells = true;
  trees.check(make_spiral(20000), quantized);
  trees.check(make_spiral(9000), rules_for(20, 8));
}

TEST_P(OctreeLists, AreRightForBadInput) {
  Random random(13);
  TreeCheck trees(GetParam());
  const OctreeRules rules = rules_for(4, 6);
  const std::vector<Vec3> one = {{0.3, -2.0, 5.0}};
  trees.check(one, rules);
  const std::vector<Vec3> same(300, {1.0, 2.0, 3.0});
  trees.check(same, rules);
  trees.check(same, one, rules);
  auto twice = reference::make_cloud(Cloud::tube, 400, {}, 1.0, random);
  twice.insert(twice.end(), twice.begin(), twice.begin() + 400);
  trees.check(twice, rules);
  std::vector<Vec3> line;
  for (int i = 0; i < 500; ++i) line.push_back({0.01 * i, 0.0, 0.0});
  trees.check(line, rules);
  trees.check(twice, line, rules);
  line.push_back({1e12, -1e12, 1e12});
  trees.check(line, rules);
  line.push_back({std::numeric_limits<double>::quiet_NaN(), 0.0, std::numeric_limits<double>::infinity()});
  trees.check(line, rules);
  trees.check(line, twice, rules);
}

// Chains of boxes down to nodes that no box can tell apart: more boxes than there was room for, again and again.
TEST_P(OctreeLists, AreRightWhereTreesOutgrowTheirMemory) {
  Random random(14);
  const OctreeRules rules = rules_for(8, 3);
  for (const int n_places : {1, 3, 40, 300}) {
    TreeCheck fresh(GetParam());
    const auto places = reference::make_cloud(Cloud::cube, n_places, {0.2, 0.1, 0.0}, 1.0, random);
    std::vector<Vec3> nodes;
    for (int k = 0; k < 25; ++k) nodes.insert(nodes.end(), places.begin(), places.end());
    fresh.check(nodes, rules);
    fresh.check(reference::make_cloud(Cloud::cluster, 900, {}, 1.0, random), nodes, rules);
    fresh.check(nodes, rules);
  }
}

INSTANTIATE_TEST_SUITE_P(Counts, OctreeLists, testing::Bool(),
                         [](const auto& test) { return test.param ? "LookedAtTogether" : "LookedAtOneByOne"; });

}  // namespace
}  // namespace skein
