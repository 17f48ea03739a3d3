#pragma once

#include <skein/fmm/fmm_sum.hpp>
#include <skein/ranks/communicator.hpp>

#include "fmm/deliveries.hpp"
#include "fmm/essential_tree.hpp"
#include "fmm/passes.hpp"
#include "fmm/rank_shares.hpp"

namespace skein {

/// What ranks that share a sum tell each other.
class RankExchange {
 public:
  /// A rank has what it looks at alone: coefficients of other ranks' boxes are sent to it.
  static constexpr bool spares_memory = true;
  /// Where there are many nodes each makes a part of the tree.
  static constexpr bool makes_parts = true;

  /// Divides a new tree, and gives back what this rank has no use for.
  void share(Communicator& ranks, HostOctree& tree, const FmmPlan& plan, bool is_symmetric);
  const RankShares& shares() const { return shares_; }
  PassedBoxes boxes() const { return {shares_.source_boxes, shares_.target_boxes, shares_.boxes_of_all, {}}; }

  template <class Real>
  void exchange_coefficients(const Coefficients<HostSpace, Real>& coefficients);
  /// Own targets' velocities to rank 0.
  void gather_velocities(const HostOctree& tree, const HostVectors& velocity);
  /// The same to the ranks that own the targets.
  void deliver_velocities(const HostOctree& tree, const RankParts& owners, const HostVectors& velocity);

  /// A part of a new tree on each rank, and its nodes. See EssentialTree.
  /// @param given  own nodes of each rank  @param own  those of this one
  void make_part(Communicator& ranks, const RankParts& given, const OctreeRules& rules, HostOctree& tree,
                 const UnsortedNodes<HostSpace>& own, double one_blob, double scale, SortedNodes<HostSpace>& nodes);
  /// Moves nodes to the places that they had. @returns false where some have left their leaves
  bool keeps_part(const HostOctree& tree, const UnsortedNodes<HostSpace>& own, double one_blob, double scale,
                  SortedNodes<HostSpace>& nodes);
  /// Divides the work of such a tree.
  void share_part(HostOctree& tree, const FmmPlan& plan, bool is_symmetric);
  const std::vector<int>& first_tile() const { return part_.first_tile(); }
  /// Velocities to the ranks whose nodes they are of. @param to_rank_0  and from there to rank 0
  void return_velocities(const RankParts& given, bool to_rank_0, const HostVectors& velocity);
  /// Which have been returned: of own nodes, or on rank 0 of all.
  const HostVectors& velocity() const { return velocity_; }
  /// Counts of the tree of all parts.
  void count_whole(const RankParts& given, FmmStatistics& statistics) const;
  double part_bytes() const { return part_.bytes(); }

 private:
  Communicator* ranks_ = nullptr;
  RankShares shares_;
  std::vector<double> send_, receive_;
  EssentialTree part_;
  HostVectors velocity_;
  Deliveries deliveries_;                ///< of the tree
  std::vector<std::size_t> listed_for_;  ///< counts of the owners; empty: to be listed
};

}  // namespace skein
