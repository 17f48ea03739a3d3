#pragma once

#include <skein/arrays/sources.hpp>
#include <skein/arrays/types.hpp>
#include <skein/core/precision.hpp>
#include <skein/ranks/communicator.hpp>

#include "kernels/pair_rounds.hpp"

#include <string>
#include <vector>

namespace skein {

/// A direct sum that ranks share. Its order depends on the nodes alone, so that any number of ranks, one included,
/// makes the same bits: where each pair is weighed once, that of PairRounds; else each target's sum is one rank's.
class DirectShare {
 public:
  /// To be called by all ranks with the same arguments. @param velocity  of rank 0: the sum is added to it
  /// @param owners  of the targets, who get the sums at theirs: velocity is [owners->count[rank], 3]; null: rank 0
  void add_velocity(Communicator& ranks, const Sources& sources, const ConstVectors& target, const Vectors& velocity,
                    double viscosity, Precision precision, bool by_teams, const RankParts* owners = nullptr);

  /// Of the last sum, in words.
  const std::string& partition() const { return partition_; }

 private:
  void add_for_targets(Communicator& ranks, const Sources& sources, const ConstVectors& target, const Vectors& velocity,
                       double viscosity, Precision precision, bool by_teams, const RankParts* owners);
  template <class Space>
  void add_in_rounds(const Space& space, Communicator& ranks, const Sources& sources, const Vectors& velocity,
                     double viscosity, Precision precision, const RankParts* owners);
  /// Velocities of the nodes between two edges each to rank 0, which adds them. @param own  [n_own, 3], column by
  /// column
  void collect(Communicator& ranks, const double* own, const std::vector<int>& first, const Vectors& velocity);

  Scalars partial_;                            ///< scratch of the teams
  std::vector<HostVectors> blocks_, scratch_;  ///< what own blocks of rounds contribute to all nodes
  std::vector<double> send_, received_, gathered_;
  std::string partition_;
};

}  // namespace skein
