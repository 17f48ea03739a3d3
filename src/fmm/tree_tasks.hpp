#pragma once

#include "fmm/octree.hpp"

#include <vector>

namespace skein {

/// The leaves with targets, cut into parts of so many targets at most: each is the task of a thread or a team.
template <class Space>
struct LeafParts {
  Kokkos::View<int*, Space> leaf;   ///< of each part
  Kokkos::View<int*, Space> place;  ///< of each part, among those of its leaf
  Kokkos::View<int*, Space> first;  ///< per target leaf its first part; at the end, their number
  int n_leaves = 0;
  int n_parts = 0;  ///< or more, where the tree defers a look at it

  /// @param wanted  places of targets in the tree's order: parts of leaves elsewhere are left out
  void build(const Space& space, const Octree<Space>& tree, int most_targets, IndexRange wanted);
  double bytes() const { return 4.0 * static_cast<double>(leaf.extent(0) + place.extent(0) + first.extent(0)); }
};

/// Far pairs that share an operator stand together, in the order of the V lists.
template <class Space>
struct FarOrder {
  KeyedOrder<Space> pairs;          ///< places in v_list.entries, key: n_transfers level + index
  Kokkos::View<int*, Space> place;  ///< of v_list.entries in that order
  int n_pairs = 0;                  ///< in all
  int n_kept = 0;                   ///< that are here
  IndexRange targets;               ///< places in the tree's order: pairs are here of boxes with any of these

  void build(const Space& space, Octree<Space>& tree);

  /// After build: leaves out the pairs of boxes without targets in `own`. Those that stay keep their order.
  void keep(const Space& space, Octree<Space>& tree, IndexRange own);

  /// All pairs, cut into runs of so many. @returns where in `pairs` each of them begins, and the end of the last: runs
  /// are the same, whoever keeps which of their pairs
  std::vector<int> cut(int n_at_once) const;

  double bytes() const { return pairs.bytes() + 4.0 * static_cast<double>(place.extent(0) + n_before_.extent(0)); }

 private:
  Kokkos::View<int*, Space>
      n_before_;  ///< per pair in the order of all, how many before it are here; where some are not
};

/// Pairs of nodes that each target leaf sums one by one. @param n_pairs  [n_target_leaves], overwritten
template <class Space>
void count_near_pairs(const Space& space, const Octree<Space>& tree, const ScalarView<Space>& n_pairs);

}  // namespace skein
