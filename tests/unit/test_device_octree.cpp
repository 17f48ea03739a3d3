#include "fmm/device_octree.hpp"
#include "fmm/morton.hpp"
#include "fmm/octree.hpp"
#include "tests/reference/point_cloud.hpp"
#include "tests/unit/stokeslet_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

// The tree in the execution space's memory against the host's, box by box and list by list.

namespace skein {
namespace {

using reference::Cloud;
using reference::Random;

template <class Entry>
std::vector<Entry> read_list(const Kokkos::View<Entry*, ExecSpace>& device, const int n) {
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), device);
  std::vector<Entry> list;
  for (int i = 0; i < n; ++i) list.push_back(host(i));
  return list;
}

/// To the first entries of an array.
template <class Entry>
void write_list(const Kokkos::View<Entry*, ExecSpace>& device, const std::vector<Entry>& list) {
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), device);
  std::copy(list.begin(), list.end(), host.data());
  Kokkos::deep_copy(device, host);
}

std::vector<int> make_order(const int n) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

bool operator==(const skein::IndexRange& a, const skein::IndexRange& b) {
  return a.first == b.first && a.count == b.count;
}

bool are_equal(const Box& a, const Box& b) {
  return a.level == b.level && a.parent == b.parent && a.n_children == b.n_children &&
         (a.is_leaf() || a.first_child == b.first_child) && a.octant == b.octant &&
         std::equal(a.cell, a.cell + 3, b.cell) && a.sources == b.sources && a.targets == b.targets;
}
bool are_equal(const FarPair& a, const FarPair& b) {
  return a.target == b.target && a.source == b.source && std::equal(a.transfer, a.transfer + 3, b.transfer);
}
bool are_equal(const int a, const int b) { return a == b; }
bool are_equal(const skein::IndexRange& a, const skein::IndexRange& b) { return a == b; }

/// The same entries, list by list; `sorted` where the order within a list may differ.
template <class Entry>
void expect_same_lists(const std::string& name, const ListOfLists<Entry>& expected, std::vector<Entry> entries,
                       const std::vector<int>& first, const std::vector<int>& end, const bool in_any_order) {
  const int n_lists = static_cast<int>(expected.first.size()) - 1;
  ASSERT_EQ(static_cast<int>(end.size()), n_lists) << name;
  for (int i = 0; i < n_lists; ++i) {
    const auto at = static_cast<std::size_t>(i);
    std::vector<Entry> wanted(expected.begin(i), expected.end(i));
    const std::vector<Entry> got(entries.begin() + first[at], entries.begin() + end[at]);
    ASSERT_EQ(got.size(), wanted.size()) << name << " of list " << i;
    for (const Entry& entry : got) {
      const auto found =
          std::find_if(wanted.begin(), wanted.end(), [&](const Entry& other) { return are_equal(entry, other); });
      ASSERT_NE(found, wanted.end()) << name << " of list " << i;
      if (!in_any_order) {
        ASSERT_EQ(found, wanted.begin()) << name << " of list " << i << " in another order";
      }
      wanted.erase(found);
    }
  }
}

template <class Entry>
void expect_same_lists(const std::string& name, const ListOfLists<Entry>& expected,
                       const DeviceLists<Entry, ExecSpace>& lists, const bool in_any_order) {
  const int n_lists = static_cast<int>(expected.first.size()) - 1;
  const std::vector<int> bounds = read_list(lists.first, n_lists + 1);
  ASSERT_EQ(lists.n_entries, static_cast<int>(expected.entries.size())) << name;
  expect_same_lists(name, expected, read_list(lists.entries, lists.n_entries), bounds,
                    std::vector<int>(bounds.begin() + 1, bounds.end()), in_any_order);
}

void expect_same_tree(const Octree& host, const DeviceOctree<ExecSpace>& device) {
  ASSERT_EQ(device.n_boxes(), static_cast<int>(host.boxes().size()));
  ASSERT_EQ(device.n_levels(), host.n_levels());
  const auto boxes = read_list(device.boxes, device.n_boxes());
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    ASSERT_TRUE(are_equal(boxes[b], host.boxes()[b])) << "box " << b;
  }
  for (std::size_t b = 0; b < boxes.size(); b += boxes.size() / 5 + 1) {
    const Vec3 one = device.cube.center(boxes[b]), other = host.center(host.boxes()[b]);
    EXPECT_TRUE(!(norm(one - other) > 1e-9 * device.half_width(boxes[b].level))) << "box " << b;
  }
  for (int level = 0; level < host.n_levels(); ++level) {
    EXPECT_EQ(device.half_width(level), host.half_width(level));
    EXPECT_TRUE(device.level(level) == host.level(level));
  }
  const auto sources = read_list(device.source_order(), device.n_sources);
  const auto targets = read_list(device.target_order(), device.n_targets);
  EXPECT_TRUE(std::equal(sources.begin(), sources.end(), host.source_order().data()));
  EXPECT_TRUE(std::equal(targets.begin(), targets.end(), host.target_order().data()));
  EXPECT_EQ(read_list(device.target_leaves, device.n_target_leaves), host.target_leaves());
  EXPECT_EQ(device.largest_leaf, host.largest_leaf());
  EXPECT_EQ(device.transfers_met(), host.transfers_met());
  expect_same_lists("V", host.v_list(), device.v_list, false);
  expect_same_lists("X", host.x_list(), device.x_list, false);
  expect_same_lists("W", host.w_list(), device.w_list, true);
  expect_same_lists("U", host.u_list(), read_list(device.u_list.entries, device.u_list.n_entries),
                    read_list(device.u_list.first, device.n_target_leaves),
                    read_list(device.near_end, device.n_target_leaves), false);
  double n_near_pairs = 0.0;
  for (int leaf = 0; leaf < device.n_target_leaves; ++leaf)
    for (const skein::IndexRange* run = host.u_list().begin(leaf); run != host.u_list().end(leaf); ++run)
      n_near_pairs +=
          static_cast<double>(run->count) *
          host.boxes()[static_cast<std::size_t>(host.target_leaves()[static_cast<std::size_t>(leaf)])].targets.count;
  EXPECT_EQ(device.n_near_pairs, n_near_pairs);
}

/// Trees of sources with targets apart and of sources that are the targets; the same trees again in used memory.
class Comparison {
 public:
  void compare(const std::vector<Vec3>& source, const std::vector<Vec3>& target, const OctreeRules& rules) {
    Octree host;
    host.build(make_host_vectors(source), make_host_vectors(target), rules);
    device_.build(ExecSpace(), to_device("source", source), to_device("target", target), rules);
    expect_same_tree(host, device_);
  }
  void compare(const std::vector<Vec3>& nodes, const OctreeRules& rules) {
    Octree host;
    const HostVectors array = make_host_vectors(nodes);
    host.build(array, array, rules);
    const Vectors on_device = to_device("nodes", nodes);
    device_.build(ExecSpace(), on_device, on_device, rules);
    expect_same_tree(host, device_);
  }

 private:
  DeviceOctree<ExecSpace> device_;
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

TEST(DeviceSort, IsTheHostsSort) {
  Random random(9);
  SortSpace<ExecSpace> memory;
  KeyedOrder<ExecSpace> sorted;
  for (const int n : {1, 2, 31, 32, 33, 1000, 70000, 5})
    for (const int n_bits : {3, 15, 60}) {
      const Kokkos::View<std::uint64_t*, HostSpace> key("key", n), spare_key("spare_key", n);
      const Kokkos::View<int*, HostSpace> order("order", n), spare_order("spare_order", n);
      std::vector<std::uint64_t> unsorted_key;
      for (int i = 0; i < n; ++i) {
        // Every key several times, so that a sort that is not stable shows.
        key(i) = random.bits() % static_cast<std::uint64_t>(n / 3 + 1) << (n_bits > 17 ? n_bits - 17 : 0);
        key(i) &= (std::uint64_t{1} << n_bits) - 1;
        order(i) = i;
        unsorted_key.push_back(key(i));
      }
      sort_by_key(key, order, n, n_bits, spare_key, spare_order);
      for (const int few : {0, 1000}) {  // digit by digit, and by comparisons
        sorted.require(static_cast<std::size_t>(n));
        write_list(sorted.key, unsorted_key);
        write_list(sorted.order, make_order(n));
        sort_on_device(ExecSpace(), sorted, n, n_bits, memory, few);
        const auto keys = read_list(sorted.key, n);
        const auto orders = read_list(sorted.order, n);
        EXPECT_TRUE(std::equal(keys.begin(), keys.end(), key.data())) << n << " keys of " << n_bits << " bits, " << few;
        EXPECT_TRUE(std::equal(orders.begin(), orders.end(), order.data()))
            << n << " keys of " << n_bits << " bits, " << few;
      }
    }
}

TEST(DeviceOctree, IsTheHostsTreeOfClouds) {
  Random random(11);
  Comparison trees;
  for (const Cloud cloud : reference::all_clouds)
    for (const int leaf_size : {1, 6, 40})
      for (const int min_sources : {0, 9, 1000}) {
        SCOPED_TRACE(reference::name_of(cloud) + " leaves of " + std::to_string(leaf_size) + ", expansions from " +
                     std::to_string(min_sources));
        const auto source = reference::make_cloud(cloud, 1500, {3.0, -1.0, 0.4}, 0.7, random);
        const auto target = reference::make_cloud(Cloud::cluster, 700, {3.1, -1.0, 0.4}, 0.5, random);
        trees.compare(source, target, rules_for(leaf_size, min_sources));
        trees.compare(target, source, rules_for(leaf_size, min_sources, 0.02));
        trees.compare(source, rules_for(leaf_size, min_sources));
      }
}

TEST(DeviceOctree, IsTheHostsTreeOfManyNodes) {
  Random random(12);
  Comparison trees;
  trees.compare(reference::make_cloud(Cloud::cube, 30000, {}, 1.0, random), rules_for(50, 56));
  OctreeRules quantized = rules_for(30, 20);
  quantized.has_quantized_cells = true;
  trees.compare(make_spiral(20000), quantized);
  trees.compare(make_spiral(9000), rules_for(20, 8));
}

TEST(DeviceOctree, IsTheHostsTreeOfBadInput) {
  Random random(13);
  Comparison trees;
  const OctreeRules rules = rules_for(4, 6);
  const std::vector<Vec3> one = {{0.3, -2.0, 5.0}};
  trees.compare(one, rules);
  const std::vector<Vec3> same(300, {1.0, 2.0, 3.0});
  trees.compare(same, rules);
  trees.compare(same, one, rules);
  auto twice = reference::make_cloud(Cloud::tube, 400, {}, 1.0, random);
  twice.insert(twice.end(), twice.begin(), twice.begin() + 400);
  trees.compare(twice, rules);
  std::vector<Vec3> line;
  for (int i = 0; i < 500; ++i) line.push_back({0.01 * i, 0.0, 0.0});
  trees.compare(line, rules);
  trees.compare(twice, line, rules);
  line.push_back({1e12, -1e12, 1e12});
  trees.compare(line, rules);
  line.push_back({std::numeric_limits<double>::quiet_NaN(), 0.0, std::numeric_limits<double>::infinity()});
  trees.compare(line, rules);
  trees.compare(line, twice, rules);
}

}  // namespace
}  // namespace skein
