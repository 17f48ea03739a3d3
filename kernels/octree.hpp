#pragma once

#include <skein/core/types.hpp>

#include "kernels/stokeslet_block.hpp"

#include <cstdint>
#include <vector>

namespace skein {

/// A cube of the tree. Boxes without nodes do not exist; a box may hold sources only or targets only.
struct Box {
  int level = 0;
  int parent = -1;
  int first_child = 0;
  int n_children = 0;    ///< 0: a leaf
  int octant = 0;        ///< in the parent: bit c is set on the upper side of axis c
  int cell[3] = {};      ///< position in the grid of its level
  Run sources, targets;  ///< in the order of the tree
  bool is_leaf() const { return n_children == 0; }
};

/// A pair of the V lists: boxes of one level that do not touch, while their parents do.
struct FarPair {
  int target = 0, source = 0;
  signed char transfer[3] = {};  ///< source cell - target cell, -3 .. 3
};

/// One number for a transfer vector and all its mirror images, below 64.
inline int transfer_index(const signed char (&t)[3]) {
  const auto size = [](const int i) { return i < 0 ? -i : i; };
  return size(t[0]) + 4 * size(t[1]) + 16 * size(t[2]);
}
/// Which axes of a transfer vector are mirrored: bit c for axis c.
inline int reflected_axes(const signed char (&t)[3]) { return (t[0] < 0) + 2 * (t[1] < 0) + 4 * (t[2] < 0); }

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

/// What shapes a tree.
struct OctreeRules {
  int leaf_size = 64;                 ///< nodes per leaf to aim at, >= 1; in clouds up to twice as many
  double min_half_width = 0.0;        ///< no leaf is smaller, length
  bool has_quantized_cells = false;   ///< sides in steps, for operators that depend on them and are to be kept
  int min_sources_for_expansion = 0;  ///< fewer sources (or targets) than this are summed directly across W and X lists
};

/// An adaptive octree over sources and targets, with the interaction lists of the fast multipole method
/// (U, V, W, X of Ying, Biros and Zorin, J. Comput. Phys. 196, 2004). On the host.
///
/// Coincident and collinear nodes are fine: the depth is limited. The tree is a function of the positions alone, so a
/// restarted run meets the same sums. Memory is kept between builds.
class Octree {
 public:
  /// @param source, target  [n, 3], length; the same array where the sources are the targets
  void build(const ConstVectorView<HostSpace>& source, const ConstVectorView<HostSpace>& target,
             const OctreeRules& rules);

  const std::vector<Box>& boxes() const { return boxes_; }
  int n_levels() const { return static_cast<int>(level_first_.size()) - 1; }
  Run level(const int l) const {
    const auto i = static_cast<std::size_t>(l);
    return {level_first_[i], level_first_[i + 1] - level_first_[i]};
  }
  Vec3 center(const Box& box) const;
  double half_width(const int level) const { return 0.5 * side_ / static_cast<double>(1 << level); }

  /// Half-width of the largest leaf with targets, length.
  double largest_leaf() const { return largest_near_; }
  double bytes() const;

  /// Place in the tree's order -> index in the caller's arrays.
  const Kokkos::View<int*, HostSpace>& source_order() const { return source_order_; }
  const Kokkos::View<int*, HostSpace>& target_order() const { return target_order_; }

  const std::vector<int>& target_leaves() const { return target_leaves_; }  ///< leaves with targets
  const ListOfLists<Run>& near_sources() const { return near_; }            ///< U, per target leaf: runs of sources
  /// U where sources are the targets, each pair of leaves once: for a target leaf the leaves (in target_leaves) from
  /// itself on that it exchanges velocities with, and the runs that it only receives from.
  const ListOfLists<int>& near_partners() const { return partners_; }
  const ListOfLists<Run>& one_way_sources() const { return one_way_; }
  bool has_same_nodes() const { return same_nodes_; }
  const ListOfLists<int>& fine_sources() const { return fine_; }      ///< W, per target leaf: boxes
  const ListOfLists<FarPair>& far_pairs() const { return far_; }      ///< V, per box
  const ListOfLists<int>& coarse_sources() const { return coarse_; }  ///< X, per box: leaves
  /// Bit i is set where far pairs with transfer_index i exist.
  std::uint64_t transfers_met() const { return transfers_met_; }

 private:
  void choose_cube(const ConstVectorView<HostSpace>& source, const ConstVectorView<HostSpace>& target,
                   const OctreeRules& rules);
  void split_boxes(int leaf_size);
  void build_lists(const OctreeRules& rules);
  void add_near(int leaf, int other);
  void add_leaf_lists(int leaf, const OctreeRules& rules, std::vector<int>& stack);

  double corner_[3] = {};
  double side_ = 1.0;
  int max_depth_ = 0;
  int nodes_per_cell_ = 0;
  double largest_near_ = 0.0;
  int aimed_depth_ = 0;  ///< where leaves hold about leaf_size nodes; smaller boxes are split only when they hold more
  std::vector<Box> boxes_;
  std::vector<int> level_first_;
  Kokkos::View<int*, HostSpace> source_order_, target_order_;
  Kokkos::View<std::uint64_t*, HostSpace> source_key_, target_key_;
  Kokkos::View<int*, HostSpace> spare_order_;
  Kokkos::View<std::uint64_t*, HostSpace> spare_key_;
  ListOfLists<int> touching_;  ///< per box: boxes of its level that touch it, and coarser leaves that do
  std::vector<int> target_leaves_;
  ListOfLists<Run> near_, one_way_;
  ListOfLists<int> partners_;
  ListOfLists<int> fine_, coarse_;
  ListOfLists<int> coarse_direct_;  ///< what would be X pairs of leaves with too few targets for an expansion
  ListOfLists<FarPair> far_;
  std::uint64_t transfers_met_ = 0;
  bool same_nodes_ = false;
};

}  // namespace skein
