#pragma once

#include "fmm/blob_tail.hpp"
#include "fmm/host_leaves.hpp"
#include "fmm/host_workers.hpp"
#include "fmm/near_tiles.hpp"
#include "fmm/rank_exchange.hpp"

namespace skein {

/// Across the V lists (M2L) of some boxes of each level; overwrites their coefficients for targets.
template <class Real, class Field>
void transfer_on_host(const Passes<HostSpace, Real, Field>& passes, const std::vector<IndexRange>& boxes_of_level);

/// How a sum goes through a host, with its vector units: for FmmEvaluator.
class HostWorkers {
 public:
  using Space = HostSpace;
  using Exchange = RankExchange;
  static constexpr int part_targets = host_part_targets;
  static constexpr bool defers_counts = false;
  static constexpr bool meets_pairs_once = true;  ///< where sources are targets, with one blob

  void take(const Space&, const Octree<Space>&) { near_matches_ = {}; }
  void take_share(const Space&, const Octree<Space>&, IndexRange) {}  ///< lists have been cut
  /// Who meets whom, where each pair is to be met once; else all of U is summed by targets.
  /// @param shares, first_tile  see make_near_matches
  void meet_once(const Octree<Space>& tree, const RankShares* shares, const std::vector<int>* first_tile) {
    if (near_matches_.tiles.empty()) near_matches_ = make_near_matches(tree, shares, first_tile);
  }
  void meet_twice() { near_matches_ = {}; }

  template <class Work>
  void for_boxes(const char* label, const IndexRange boxes, const Work& work) const {
    for_boxes_on_host(label, boxes, work);
  }
  template <class Real, class Field>
  void transfer(const Passes<Space, Real, Field>& passes, const std::vector<IndexRange>& boxes_of_level) const {
    transfer_on_host(passes, boxes_of_level);
  }
  template <class Near, class Real, class Field>
  void sum_leaves(const Passes<Space, Real, Field>& passes, const LeafParts<Space>& parts,
                  const HostVectors& velocity) {
    if constexpr (std::is_same_v<Field, TailField>)  // has no near field
      return sum_leaf_velocities<double>(passes, NearField{}, parts, velocity);
    sum_leaf_velocities<Near>(passes, compute_near<Near>(passes.nodes, passes.u_list, passes.near_end), parts,
                              velocity);
  }

  double bytes() const {
    return 8.0 * static_cast<double>(near_velocity_.size()) + near_tiles_.bytes() + single_near_tiles_.bytes();
  }

 private:
  template <class Near>
  NearField compute_near(const SortedNodes<Space>& nodes, const Lists<IndexRange, Space>& u_list,
                         const Kokkos::View<const int*, Space>& near_end);

  NearMatches near_matches_;  ///< of the tree, once they were needed
  NearTiles<double> near_tiles_;
  NearTiles<float> single_near_tiles_;
  HostScalars near_velocity_;
};

}  // namespace skein
