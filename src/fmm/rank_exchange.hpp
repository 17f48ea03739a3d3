#pragma once

#include <skein/ranks/communicator.hpp>

#include "fmm/passes.hpp"
#include "fmm/rank_shares.hpp"

#include <utility>

namespace skein {

/// What ranks that share a sum tell each other.
class RankExchange {
 public:
  /// Divides a new tree, and gives back what this rank has no use for.
  void share(Communicator& ranks, HostOctree& tree, const FmmPlan& plan, bool is_symmetric);
  /// Of a tree of which each rank has a part.
  void share(Communicator& ranks, RankShares shares) {
    ranks_ = &ranks;
    shares_ = std::move(shares);
  }
  const RankShares& shares() const { return shares_; }
  PassedBoxes boxes() const { return {shares_.source_boxes, shares_.target_boxes, shares_.boxes_of_all, {}}; }

  template <class Real>
  void exchange_coefficients(const Coefficients<HostSpace, Real>& coefficients);
  /// Own targets' velocities to rank 0.
  void gather_velocities(const HostOctree& tree, const HostVectors& velocity);
  /// The same to the ranks that own the targets.
  void deliver_velocities(const HostOctree& tree, const RankParts& owners, const HostVectors& velocity);

 private:
  Communicator* ranks_ = nullptr;
  void list_deliveries(const HostOctree& tree, const RankParts& owners);

  RankShares shares_;
  std::vector<double> send_, receive_;
  /// Own targets in the order of those that own them, and owned ones in the order of those that sum them; of the tree.
  std::vector<int> sent_targets_, received_targets_;
  std::vector<std::size_t> n_sent_, n_received_;  ///< [n_ranks], numbers; empty: to be listed
  std::vector<std::size_t> listed_for_;           ///< counts of the owners
};

}  // namespace skein
