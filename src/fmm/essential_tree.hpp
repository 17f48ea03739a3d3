#pragma once

#include "fmm/essential_boxes.hpp"
#include "fmm/node_deal.hpp"
#include "fmm/node_places.hpp"
#include "fmm/rank_shares.hpp"

#include <vector>

namespace skein {

/// A rank's part of an octree over nodes of which each rank owns some: the locally essential tree of Warren and Salmon
/// (Supercomputing '93), by ranges of Morton keys. It has the upper boxes of the whole tree, all that is below those
/// that are this rank's, and of other ranks what the lists of its own targets ask for, in the order of the whole tree:
/// no sum has another order than there. Sources are targets.
///
/// All functions that are given ranks are to be called by all of them.
class EssentialTree {
 public:
  /// Makes the part, with its lists. @param own  [owners.count[rank], 3], length: the nodes that this rank owns
  void build(Communicator& ranks, const ConstVectorView<HostSpace>& own, const RankParts& owners,
             const OctreeRules& rules, HostOctree& tree);

  /// Nodes from their owners to the ranks that have their places. @param own  whose positions are, or were, those of
  /// build  @param one_blob  of all sources; 0: they differ
  void move_nodes(Communicator& ranks, const HostOctree& tree, const UnsortedNodes<HostSpace>& own, double one_blob,
                  double scale, SortedNodes<HostSpace>& nodes);
  /// True where every node that was moved is still in its leaf: see seek_strays.
  bool still_fits(Communicator& ranks, const HostOctree& tree, const SortedNodes<HostSpace>& nodes) const;

  /// Who has which boxes.
  RankShares make_shares(Communicator& ranks, const HostOctree& tree, const FmmPlan& plan, bool is_symmetric);
  /// Per box of the tree: of leaves, the number of their first tile among those of the whole tree.
  const std::vector<int>& first_tile() const { return first_tile_; }

  /// Velocities to the owners of the nodes. @param velocity  [tree.n_targets, 3]
  /// @param own  [owners.count[rank], 3], overwritten
  void return_velocities(Communicator& ranks, const HostVectors& velocity, const HostVectors& own) {
    deal_.return_velocities(ranks, velocity, own_places_.first, own);
  }

  /// Of the whole tree.
  struct Totals {
    int n_boxes = 0, n_leaves = 0;
    double near_pairs = 0.0, far_pairs = 0.0;
  };
  const Totals& totals() const { return totals_; }
  /// Besides the tree.
  double bytes() const;

 private:
  void split_own(const OctreeCube& cube);
  int number_tiles(Communicator& ranks);
  void assemble(const std::vector<std::vector<BoxRecord>>& others, int n_levels, HostOctree& tree);
  void ask_for_nodes(Communicator& ranks, HostOctree& tree);
  double count_far_pairs(const HostOctree& tree) const;
  void add_up(Communicator& ranks, double far_pairs, HostOctree& tree);
  std::vector<float> weigh(const HostOctree& tree, const FmmPlan& plan, bool is_symmetric) const;

  int rank_ = 0;
  NodeDeal deal_;
  OwnBoxes own_boxes_;  ///< while the tree is built
  NodePlaces places_;
  IndexRange own_places_;           ///< in the tree
  RowMoves to_neighbours_;          ///< copies of nodes, from those that have their places
  std::vector<int> place_of_copy_;  ///< in the tree
  std::vector<int> owner_;          ///< per box of the tree: rank, or TopTree::several
  std::vector<int> first_tile_;
  Kokkos::View<Box*, HostSpace> own_leaves_;
  Totals totals_;
};

}  // namespace skein
