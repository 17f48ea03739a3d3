#pragma once

#include <skein/fmm/fmm_plan.hpp>

#include "fmm/octree.hpp"

#include <vector>

namespace skein {

/// How ranks divide a tree that all of them have: consecutive leaves for each, with about as much work by the counts of
/// lists. Nothing of a sum's order depends on it.
///
/// A box whose sources are all one rank's is that rank's, which makes its coefficients and sends them to those that
/// need them. The few others, whose sources are several ranks', are made by all.
struct RankShares {
  int rank = 0, n_ranks = 1;
  std::vector<int> first_source, first_target;   ///< [n_ranks + 1], places in the tree's order, at edges of leaves
  std::vector<IndexRange> source_boxes;          ///< of this rank, per level
  std::vector<IndexRange> target_boxes;          ///< with targets of this rank, per level
  std::vector<int> boxes_of_all;                 ///< whose sources are several ranks', fine ones first
  std::vector<std::vector<int>> sent, received;  ///< [n_ranks]: boxes whose coefficients go to or come from a rank
  std::vector<IndexRange> source_runs;           ///< places whose sources this rank looks at, in pieces for a thread
  double n_boxes = 0.0;                          ///< whose coefficients it has, of sources and for targets
  double balance = 1.0;                          ///< the largest work of a rank over the mean

  /// After all boxes are known.
  void count_boxes();

  IndexRange own_targets() const { return range(first_target); }
  IndexRange own_sources() const { return range(first_source); }
  double n_looked_at() const {
    double sum = 0.0;
    for (const IndexRange& run : source_runs) sum += run.count;
    return sum;
  }
  bool has_target(const int place) const {
    const IndexRange own = own_targets();
    return place >= own.first && place < own.first + own.count;
  }

 private:
  IndexRange range(const std::vector<int>& first) const {
    const auto r = static_cast<std::size_t>(rank);
    return {first[r], first[r + 1] - first[r]};
  }
};

/// Who has a place. @param first  [n_ranks + 1], where the places of each rank begin
int rank_of(const std::vector<int>& first, int place);

/// Boxes of a level, and another one behind them with all between.
void widen(IndexRange& boxes, int b);

/// Work that begins at a place in the tree's order, at which ranks may be divided if a leaf begins there.
struct WorkPiece {
  int first = 0;
  double work = 0.0;
  bool is_leaf = false;
};

/// Edges between ranks with about as much work. @param pieces  in any order, put in that of their places
/// @param balance  overwritten with the largest work of a rank over the mean
std::vector<int> cut_work(std::vector<WorkPiece>& pieces, int n_places, int n_ranks, double& balance);

/// @param is_symmetric  the near field meets each pair once
RankShares share_tree(const HostOctree& tree, const FmmPlan& plan, bool is_symmetric, int rank, int n_ranks);

/// Gives back the V lists of all boxes but those of each level. @param boxes_of_level  [n_levels]
void drop_far_pairs_but(const std::vector<IndexRange>& boxes_of_level, HostOctree& tree);

}  // namespace skein
