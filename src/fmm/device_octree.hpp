#pragma once

#include "fmm/device_sort.hpp"
#include "fmm/octree_cube.hpp"

#include <cstdint>
#include <vector>

namespace skein {

inline constexpr int most_touching = 27;  ///< boxes, itself among them
inline constexpr int part_targets = 128;  ///< of a leaf, that a team takes at once

/// The tree that Octree builds on hosts, box by box, in the memory of any execution space: only counts, bounds and a
/// sample's statistics pass through the host. Lists hold what Octree's hold; W lists in another order. Memory is kept
/// between builds, so arrays may be longer than what is in use.
template <class Space>
struct DeviceOctree {
  /// @param source, target  [n, 3], length; the same array where the sources are the targets
  void build(const Space& space, const ConstVectorView<Space>& source, const ConstVectorView<Space>& target,
             const OctreeRules& rules);

  /// As Octree's.
  bool still_fits(const Space& space, const ConstVectorView<Space>& source, const ConstVectorView<Space>& target) const;

  int n_levels() const { return static_cast<int>(level_first.size()) - 1; }
  int n_boxes() const { return level_first.back(); }
  IndexRange level(const int l) const {
    const auto i = static_cast<std::size_t>(l);
    return {level_first[i], level_first[i + 1] - level_first[i]};
  }
  double half_width(const int level) const { return cube.half_width(level); }
  std::uint64_t transfers_met() const { return transfers; }
  const Kokkos::View<int*, Space>& source_order() const { return sources.order; }
  const Kokkos::View<int*, Space>& target_order() const { return same_nodes ? sources.order : targets.order; }
  double bytes() const;

  OctreeCube cube;
  int n_sources = 0, n_targets = 0;
  bool same_nodes = false;
  std::vector<int> level_first = {0};
  Kokkos::View<Box*, Space> boxes;

  int n_target_leaves = 0;
  Kokkos::View<int*, Space> target_leaves;  ///< boxes
  DeviceLists<IndexRange, Space> u_list;    ///< U, per target leaf: runs of sources, first(i) .. near_end(i) - 1
  Kokkos::View<int*, Space> near_end;
  DeviceLists<int, Space> w_list;      ///< W, per target leaf: boxes
  DeviceLists<FarPair, Space> v_list;  ///< V, per box
  KeyedOrder<Space> far;  ///< V pairs by operator: places in v_list.entries, key: n_transfers level + index
  Kokkos::View<int*, Space> far_place;  ///< of v_list.entries in that order
  DeviceLists<int, Space> x_list;       ///< X, per box: leaves
  /// Parts of the target leaves, of part_targets targets at most: the leaf, and its parts before this one.
  Kokkos::View<int*, Space> part_leaf, part_place;
  int n_parts = 0;
  std::uint64_t transfers = 0;  ///< bit i: far pairs with transfer_index i exist
  double largest_leaf = 0.0;    ///< half-width of the largest leaf with targets, length
  double n_near_pairs = 0.0;    ///< of nodes

  // What the build needs besides.
  KeyedOrder<Space> sources, targets;
  SortSpace<Space> sort_memory;
  Kokkos::View<int*, Space> count;       ///< per box
  Kokkos::View<int*, Space> part_first;  ///< per target leaf
  /// Per box: boxes of its level that touch it, and coarser leaves that do. None shares a cell of that level with
  /// another, so that there are most_touching at most.
  Kokkos::View<int*, Space> touching, n_touching;
  Kokkos::View<int*, Space> totals;  ///< of counts, on their way to the host
  DeviceLists<int, Space> x_direct;  ///< what would be X pairs of leaves with too few targets for an expansion
};

/// The parts of the build after the boxes: touching boxes, V and X ...
template <class Space>
void build_far_lists(const Space& space, DeviceOctree<Space>& tree, const OctreeRules& rules);
/// ... then leaves with targets, U and W.
template <class Space>
void build_near_lists(const Space& space, DeviceOctree<Space>& tree, const OctreeRules& rules);

}  // namespace skein
