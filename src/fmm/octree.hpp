#pragma once

#include "fmm/key_sort.hpp"
#include "fmm/octree_cube.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace skein {

inline constexpr int most_touching = 27;  ///< boxes, itself among them

/// What is added up while lists are made: left by kernels, there after the next wait.
struct FoundTotals {
  enum List : int { v, x, x_direct, u, w, n_lists };
  FoundNumbers entries{"skein::octree::entries", n_lists};
  FoundNumber n_target_leaves{"skein::octree::n_target_leaves"}, coarsest_leaf{"skein::octree::coarsest_leaf"};
  Kokkos::View<std::int64_t, SharedHostMemory> near_pairs{"skein::octree::near_pairs"};
  Kokkos::View<std::uint64_t, SharedHostMemory> transfers{"skein::octree::transfers"};
};

/// An adaptive octree over sources and targets, with the interaction lists of the fast multipole method
/// (U, V, W, X of Ying, Biros and Zorin, J. Comput. Phys. 196, 2004), in the memory of any execution space: only
/// counts, bounds and a sample's statistics pass through the host.
///
/// Coincident and collinear nodes are fine: the depth is limited. The tree is a function of the positions that it was
/// built for, whatever the space and the number of threads. Memory is kept between builds, so arrays may be longer than
/// what is in use. What hands out spans and references is for hosts that reach the memory.
template <class Space>
struct Octree {
  /// @param source, target  [n, 3], length; the same array where the sources are the targets
  /// @param bounds          of all of them
  void build(const Space& space, const ConstVectorView<Space>& source, const ConstVectorView<Space>& target,
             const NodeBounds& bounds, const OctreeRules& shape);
  /// The same where bounds are still to be found, which takes one more wait.
  void build(const Space& space, const ConstVectorView<Space>& source, const ConstVectorView<Space>& target,
             const OctreeRules& shape);

  /// Launches a look whether the tree that was built last holds these nodes, moved since then by little enough: see
  /// seek_strays. The answer is there after the next wait for the device.
  void ask_whether_it_fits(const Space& space, const ConstVectorView<Space>& source,
                           const ConstVectorView<Space>& target) const;
  bool still_fits() const { return n_strays() == 0; }

  int n_levels() const { return static_cast<int>(level_first.size()) - 1; }
  int n_boxes() const { return level_first.back(); }
  IndexRange level(const int l) const {
    const auto i = static_cast<std::size_t>(l);
    return {level_first[i], level_first[i + 1] - level_first[i]};
  }
  double half_width(const int level) const { return cube.half_width(level); }
  std::uint64_t transfers_met() const { return transfers; }
  /// Place in the tree's order -> index in the caller's arrays.
  const Kokkos::View<int*, Space>& source_order() const { return sources.order; }
  const Kokkos::View<int*, Space>& target_order() const { return same_nodes ? sources.order : targets.order; }
  double bytes() const;

  const Box& box(const int b) const { return boxes(b); }
  const Box& target_leaf(const int leaf) const { return boxes(target_leaves(leaf)); }
  /// U: runs of sources that a target leaf meets one by one.
  std::span<const IndexRange> near_runs(const int leaf) const {
    return {u_list.entries.data() + u_list.first(leaf), u_list.entries.data() + near_end(leaf)};
  }

  void require_marks() { require_extent(marks, max_key_depth + 3, "skein::octree::marks"); }
  /// The first n of them. Waits for the device.
  const FoundNumbers& read_marks(const Space& space, const int n) {
    leave_for_host<Space>(space, marks, n, found);
    wait_for(space);
    return found;
  }

  /// Gives back the memory that only building needs: keys, then what near matches are made from, too.
  void drop_keys();
  void drop_touching() { touching = n_touching = count = {}; }

  /// Counts are looked at when all boxes, and then all lists, are made: each look is a wait, of which devices have then
  /// few. What outgrows its memory is made again. Else each count is looked at before anything is made by it.
  bool defers_counts = false;

  OctreeRules rules;
  OctreeCube cube;
  int n_sources = 0, n_targets = 0;
  bool same_nodes = false;
  std::vector<int> level_first = {0};
  Kokkos::View<Box*, Space> boxes;

  int n_target_leaves = 0;
  Kokkos::View<int*, Space> target_leaves;  ///< boxes
  Lists<IndexRange, Space> u_list;          ///< U, per target leaf: runs of sources, first(i) .. near_end(i) - 1
  Kokkos::View<int*, Space> near_end;
  Lists<int, Space> w_list;      ///< W, per target leaf: boxes
  Lists<FarPair, Space> v_list;  ///< V, per box
  Lists<int, Space> x_list;      ///< X, per box: leaves
  std::uint64_t transfers = 0;   ///< bit i: far pairs with transfer_index i exist
  double largest_leaf = 0.0;     ///< half-width of the largest leaf with targets, length
  double n_near_pairs = 0.0;     ///< of nodes

  FoundNumber n_strays{"skein::octree::n_strays"};  ///< nodes outside of their leaves

  // What the build needs besides.
  KeyedOrder<Space> sources, targets;
  SortSpace<Space> sort_memory;
  Kokkos::View<int*, Space> count;       ///< per box
  Kokkos::View<int*, Space> octant_end;  ///< of the boxes of a level that are split, see LevelBoxes
  Kokkos::View<int*, Space> marks;       ///< boxes before each level, or cells of each level that a sample met
  FoundNumbers found{"skein::octree::found", max_key_depth + 3};
  /// Per box: boxes of its level that touch it, and coarser leaves that do. None shares a cell of that level with
  /// another, so that there are most_touching at most.
  Kokkos::View<int*, Space> touching, n_touching;
  Lists<int, Space> x_direct;  ///< what would be X pairs of leaves with too few targets for an expansion
  FoundTotals totals;
};

using HostOctree = Octree<HostSpace>;

/// The parts of the build before the boxes: where the root lies, from bounds and a sample of the nodes ...
template <class Space>
OctreeCube choose_cube(const Space& space, Octree<Space>& tree, const ConstVectorView<Space>& source,
                       const ConstVectorView<Space>& target, const NodeBounds& bounds);
/// ... and the keys of every stride-th node, in the order of the nodes.
template <class Space>
void make_keys(const Space& space, const ConstVectorView<Space>& nodes, const KeyOf& key_of, int stride,
               const KeyedOrder<Space>& keyed);

/// The boxes, from sorted keys ...
template <class Space>
void split_boxes(const Space& space, Octree<Space>& tree);

/// ... and what is made from boxes alone: touching boxes, V and X, leaves with targets, U and W.
template <class Space>
void build_lists(const Space& space, Octree<Space>& tree);

}  // namespace skein
