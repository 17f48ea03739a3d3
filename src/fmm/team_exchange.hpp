#pragma once

#include <skein/ranks/communicator.hpp>

#include "fmm/deliveries.hpp"
#include "fmm/passes.hpp"
#include "fmm/rank_shares.hpp"

namespace skein {

/// What ranks that share a sum by teams of their devices tell each other: velocities alone. Each has the whole tree and
/// makes the coefficients of all sources, which costs a device little; across, down and at leaves it does what ends at
/// targets of its own.
class TeamExchange {
 public:
  /// Every rank has the arrays of all of the tree.
  static constexpr bool spares_memory = false;
  static constexpr bool makes_parts = false;

  /// Divides a new tree.
  void share(Communicator& ranks, const Octree<ExecSpace>& tree, const FmmPlan& plan, bool is_symmetric);
  const RankShares& shares() const { return shares_; }
  PassedBoxes boxes() const { return {shares_.source_boxes, shares_.target_boxes, {}, {}}; }

  /// Own targets' velocities to rank 0.
  void gather_velocities(const Octree<ExecSpace>& tree, const Vectors& velocity);
  /// The same to the ranks that own the targets.
  void deliver_velocities(const Octree<ExecSpace>& tree, const RankParts& owners, const Vectors& velocity);

 private:
  using Targets = Kokkos::View<const int*, ExecSpace>;

  /// Numbers in the memory of the device, and of the host for the communicator: one array where they are the same.
  struct Staged {
    Scalars here;
    Scalars::HostMirror on_host;

    void require(std::size_t n);
    Scalars first(std::size_t n) const { return Kokkos::subview(here, std::make_pair(std::size_t{0}, n)); }
  };

  void list_targets(const Octree<ExecSpace>& tree, const RankParts& owners);
  /// Velocities of some targets, to be sent.
  void pack(const Vectors& velocity, const Targets& targets);
  /// Those of some targets, from numbers that were received.
  void unpack(std::size_t first_number, const Targets& targets, const Vectors& velocity);

  Communicator* ranks_ = nullptr;
  RankShares shares_;
  Staged send_, receive_;
  Deliveries deliveries_;  ///< of the tree
  Targets sent_targets_, received_targets_;
  std::vector<std::size_t> listed_for_;  ///< counts of the owners; empty: to be listed
};

/// How ranks divide a tree in the memory of a device: consecutive leaves for each, with about as much work by what its
/// boxes and leaves are copied to the host for, the numbers of their near and far pairs.
RankShares share_targets(const Octree<ExecSpace>& tree, const FmmPlan& plan, int rank, int n_ranks);

}  // namespace skein
