#pragma once

#include <skein/ranks/communicator.hpp>

#include "fmm/deliveries.hpp"
#include "fmm/passes.hpp"
#include "fmm/rank_shares.hpp"

namespace skein {

/// What ranks that share a sum tell each other.
class RankExchange {
 public:
  /// A rank has what it looks at alone: coefficients of other ranks' boxes are sent to it.
  static constexpr bool spares_memory = true;

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

 private:
  Communicator* ranks_ = nullptr;
  RankShares shares_;
  std::vector<double> send_, receive_;
  Deliveries deliveries_;                ///< of the tree
  std::vector<std::size_t> listed_for_;  ///< counts of the owners; empty: to be listed
};

}  // namespace skein
