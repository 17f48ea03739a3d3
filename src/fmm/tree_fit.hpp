#pragma once

#include <skein/arrays/types.hpp>

#include "fmm/octree_cube.hpp"

namespace skein {

/// Nodes of a tree in the memory of any execution space: where they are now, and in which order the tree has them.
template <class Space>
struct TreeNodes {
  ConstVectorView<Space> position;  ///< [n, 3], length
  Kokkos::View<const int*, Space> order;
};

/// How far a node may leave its leaf before the leaf no longer serves, in half-widths: as far as the inner surface, on
/// which densities lie. What it costs in accuracy is measured by tests/accuracy/test_kept_tree.cpp and said in
/// docs/hydrodynamics.md.
inline constexpr double leaf_margin = 0.05;

/// Launches a count of the nodes that are outside of their leaves by more than leaf_margin; what is not a number is.
/// Does not wait for the device.
/// @param targets   empty where the sources are the targets
/// @param n_strays  is there after the next wait
template <class Space>
void seek_strays(const Space& space, const Kokkos::View<const Box*, Space>& boxes, const OctreeCube& cube,
                 const TreeNodes<Space>& sources, const TreeNodes<Space>& targets, const FoundNumber& n_strays);

/// When a tree that was built for one sum serves the next one: between the begin and the end of a step, where nodes
/// move little from sum to sum, as long as the rules stay. Outside of steps every sum has a tree of its own and depends
/// on its arguments alone; so does the first one in a step, which is why a restarted run meets the same sums.
class TreeKeeping {
 public:
  void begin_step() {
    keeps_ = true;
    has_tree_ = false;
  }
  void end_step() { keeps_ = has_tree_ = false; }

  bool has_tree() const { return has_tree_; }
  bool may_serve(const OctreeRules& rules) const { return has_tree_ && rules == rules_; }
  void note_new_tree(const OctreeRules& rules) {
    has_tree_ = keeps_;
    rules_ = rules;
  }

 private:
  bool keeps_ = false, has_tree_ = false;
  OctreeRules rules_;
};

}  // namespace skein
