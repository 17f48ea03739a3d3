#pragma once

#include "fmm/fmm_translations.hpp"
#include "kernels/ordered_matches.hpp"

namespace skein {

/// The near field of nodes that are sources and targets alike, each pair of nodes once: tiles of leaves, and who meets
/// whom in which order.
struct NearMatches {
  std::vector<IndexRange> tiles;  ///< in the order of the tree
  std::vector<Match> matches;
};

/// @param tree  of nodes that are sources and targets alike
NearMatches make_near_matches(const Octree& tree);

/// velocity([n, 3] in the order of the tree) = what leaves exchange with their partners. One blob for all nodes; in
/// single precision coordinates are rounded on the scale of a leaf.
template <class Near>
void compute_near_velocities(const SortedNodes& nodes, const NearMatches& near, const HostVectors& velocity);

}  // namespace skein
