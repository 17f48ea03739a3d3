#pragma once

#include <skein/ranks/communicator.hpp>

#include <vector>

namespace skein {

/// Which velocities go from the ranks that have summed them to the ranks that own their targets.
struct Deliveries {
  std::vector<int> sent_targets;      ///< summed here, in the order of those that own them
  std::vector<int> received_targets;  ///< owned here, in the order of those that sum them
  RankParts sent, received;           ///< numbers, three a target
};

/// @param order         [n_targets], place in the tree's order -> target
/// @param first_target  [n_ranks + 1], places that each rank sums begin here  @param owners  of targets
Deliveries list_deliveries(const int* order, const std::vector<int>& first_target, const RankParts& owners, int rank);

/// Of targets that ranks sum, three numbers each. @param first_target  as above
RankParts count_summed(const std::vector<int>& first_target);

}  // namespace skein
