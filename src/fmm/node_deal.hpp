#pragma once

#include "fmm/row_moves.hpp"
#include "fmm/sorted_nodes.hpp"
#include "fmm/top_tree.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace skein {

/// Nodes that ranks own, dealt to ranks by their places in the order of an octree over all of them. Sources are
/// targets. All functions that are given ranks are to be called by all of them.
class NodeDeal {
 public:
  /// @param own  [owners.count[rank], 3], length: the nodes that this rank owns
  /// @param memory  of which arrays for sorting are used
  void build(Communicator& ranks, const ConstVectorView<HostSpace>& own, const RankParts& owners,
             const OctreeRules& rules, HostOctree& memory);

  const OctreeCube& cube() const { return cube_; }
  const TopTree& top() const { return top_; }
  /// Places of this rank in the order of all nodes.
  IndexRange own_places() const;
  /// Keys of the nodes at own places, to be taken once.
  std::vector<std::uint64_t> take_keys() { return std::exchange(place_key_, {}); }

  /// From the owners of nodes to their places. @param own  [owners.count[rank]]  @param here  [places], those of own
  /// places from `first` on are written, times `scale`
  void move(Communicator& ranks, const ConstVectorView<HostSpace>& own, double scale, int first,
            const HostVectors& here);
  void move(Communicator& ranks, const ConstScalarView<HostSpace>& own, int first, const HostScalars& here);

  /// Velocities the other way. @param here  [places, 3], those of own places from `first` on
  /// @param own  [owners.count[rank], 3], overwritten
  void return_velocities(Communicator& ranks, const HostVectors& here, int first, const HostVectors& own);

  /// What each own place took, in any unit; goes with the velocities that are returned next, and divides the next tree.
  void note_work(std::vector<float> work) {
    place_work_ = std::move(work);
    has_new_work_ = true;
  }

  double bytes() const { return 4.0 * static_cast<double>(slot_of_place_.size() + work_.size()) + to_places_.bytes(); }

 private:
  int rank_ = 0;
  OctreeCube cube_;
  TopTree top_;
  RowMoves to_places_;
  std::vector<int> slot_of_place_;  ///< in the order in which nodes come
  std::vector<std::uint64_t> place_key_;
  std::vector<float> work_;  ///< per own node
  std::vector<float> place_work_;
  bool has_new_work_ = false;  ///< which has not gone to the owners yet
};

}  // namespace skein
