#pragma once

#include "fmm/octree.hpp"

namespace skein {

/// The leaves with targets, cut into parts of so many targets at most: each is the task of a thread or a team.
template <class Space>
struct LeafParts {
  Kokkos::View<int*, Space> leaf;   ///< of each part
  Kokkos::View<int*, Space> place;  ///< of each part, among those of its leaf
  int n_parts = 0;
  Kokkos::View<int*, Space> first;  ///< per target leaf its first part

  /// @param wanted  places of targets in the tree's order: parts of leaves elsewhere are left out
  void build(const Space& space, const Octree<Space>& tree, int most_targets, IndexRange wanted);
  double bytes() const { return 4.0 * static_cast<double>(leaf.extent(0) + place.extent(0) + first.extent(0)); }
};

/// Far pairs that share an operator stand together, in the order of the V lists.
template <class Space>
struct FarOrder {
  KeyedOrder<Space> pairs;          ///< places in v_list.entries, key: n_transfers level + index
  Kokkos::View<int*, Space> place;  ///< of v_list.entries in that order

  void build(const Space& space, Octree<Space>& tree);
  double bytes() const { return pairs.bytes() + 4.0 * static_cast<double>(place.extent(0)); }
};

}  // namespace skein
