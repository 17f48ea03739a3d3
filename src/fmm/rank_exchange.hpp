#pragma once

#include <skein/ranks/communicator.hpp>

#include "fmm/passes.hpp"
#include "fmm/rank_shares.hpp"

namespace skein {

/// What ranks that share a sum tell each other.
class RankExchange {
 public:
  /// Divides a new tree, and gives back what this rank has no use for.
  void share(Communicator& ranks, HostOctree& tree, const FmmPlan& plan, bool is_symmetric);
  const RankShares& shares() const { return shares_; }
  PassedBoxes boxes() const { return {shares_.source_boxes, shares_.target_boxes, shares_.boxes_of_all, {}}; }

  template <class Real>
  void exchange_coefficients(const Coefficients<HostSpace, Real>& coefficients);
  /// Own targets' velocities to rank 0.
  void gather_velocities(const HostOctree& tree, const HostVectors& velocity);

 private:
  Communicator* ranks_ = nullptr;
  RankShares shares_;
  std::vector<double> send_, receive_;
};

}  // namespace skein
