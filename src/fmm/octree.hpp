#pragma once

#include <skein/arrays/types.hpp>

#include "fmm/octree_cube.hpp"

#include <vector>

namespace skein {

/// Entries of several lists, one after the other: list i is entries[first[i]] .. entries[first[i + 1] - 1].
template <class Entry>
struct ListOfLists {
  std::vector<Entry> entries;
  std::vector<int> first;

  void clear() {
    entries.clear();
    first.assign(1, 0);
  }
  void end_list() { first.push_back(static_cast<int>(entries.size())); }
  const Entry* begin(const int i) const { return entries.data() + first[static_cast<std::size_t>(i)]; }
  const Entry* end(const int i) const { return entries.data() + first[static_cast<std::size_t>(i) + 1]; }
  int size(const int i) const { return static_cast<int>(end(i) - begin(i)); }
};

/// An adaptive octree over sources and targets, with the interaction lists of the fast multipole method
/// (U, V, W, X of Ying, Biros and Zorin, J. Comput. Phys. 196, 2004). On the host.
///
/// Coincident and collinear nodes are fine: the depth is limited. The tree is a function of the positions that it was
/// built for. Memory is kept between builds.
class Octree {
 public:
  /// @param source, target  [n, 3], length; the same array where the sources are the targets
  void build(const ConstVectorView<HostSpace>& source, const ConstVectorView<HostSpace>& target,
             const OctreeRules& rules);

  /// Gives back the memory that only building needs.
  void drop_keys();

  /// Gives back the V lists of all boxes but those of each level. @param boxes_of_level  [n_levels]
  void drop_far_pairs_but(const std::vector<IndexRange>& boxes_of_level);

  /// True where the tree that was built last holds these nodes, moved since then by little enough: see nodes_fit.
  bool still_fits(const ConstVectorView<HostSpace>& source, const ConstVectorView<HostSpace>& target) const;

  const std::vector<Box>& boxes() const { return boxes_; }
  const Box& box(const int b) const { return boxes_[static_cast<std::size_t>(b)]; }
  int n_levels() const { return static_cast<int>(level_first_.size()) - 1; }
  IndexRange level(const int l) const {
    const auto i = static_cast<std::size_t>(l);
    return {level_first_[i], level_first_[i + 1] - level_first_[i]};
  }
  Vec3 center(const Box& box) const;
  double half_width(const int level) const { return cube_.half_width(level); }

  /// Half-width of the largest leaf with targets, length.
  double largest_leaf() const { return largest_near_; }
  double bytes() const;

  /// Place in the tree's order -> index in the caller's arrays.
  const Kokkos::View<int*, HostSpace>& source_order() const { return source_order_; }
  const Kokkos::View<int*, HostSpace>& target_order() const { return target_order_; }

  const std::vector<int>& target_leaves() const { return target_leaves_; }  ///< leaves with targets
  const ListOfLists<IndexRange>& u_list() const { return near_; }           ///< U, per target leaf: runs of sources
  /// U where sources are the targets, each pair of leaves once: for a target leaf the leaves (in target_leaves) from
  /// itself on that it exchanges velocities with, and the runs that it only receives from.
  const ListOfLists<int>& near_partners() const { return partners_; }
  const ListOfLists<IndexRange>& one_way_sources() const { return one_way_; }
  bool has_same_nodes() const { return same_nodes_; }
  const ListOfLists<int>& w_list() const { return fine_; }     ///< W, per target leaf: boxes
  const ListOfLists<FarPair>& v_list() const { return far_; }  ///< V, per box
  const ListOfLists<int>& x_list() const { return coarse_; }   ///< X, per box: leaves
  /// Bit i is set where far pairs with transfer_index i exist.
  std::uint64_t transfers_met() const { return transfers_met_; }

 private:
  void choose_cube(const ConstVectorView<HostSpace>& source, const ConstVectorView<HostSpace>& target,
                   const OctreeRules& rules);
  void split_boxes();
  void build_lists(const OctreeRules& rules);
  void add_near(int leaf, int other);
  void add_leaf_lists(int leaf, const OctreeRules& rules, std::vector<int>& stack);

  OctreeCube cube_;
  double largest_near_ = 0.0;
  std::vector<Box> boxes_;
  std::vector<int> level_first_;
  Kokkos::View<int*, HostSpace> source_order_, target_order_;
  Kokkos::View<std::uint64_t*, HostSpace> source_key_, target_key_;
  Kokkos::View<int*, HostSpace> spare_order_;
  Kokkos::View<std::uint64_t*, HostSpace> spare_key_;
  ListOfLists<int> touching_;  ///< per box: boxes of its level that touch it, and coarser leaves that do
  std::vector<int> target_leaves_;
  ListOfLists<IndexRange> near_, one_way_;
  ListOfLists<int> partners_;
  ListOfLists<int> fine_, coarse_;
  ListOfLists<int> x_direct_;  ///< what would be X pairs of leaves with too few targets for an expansion
  ListOfLists<FarPair> far_;
  std::uint64_t transfers_met_ = 0;
  bool same_nodes_ = false;
};

}  // namespace skein
