#pragma once

#include "fmm/octree_geometry.hpp"
#include "kernels/node_bounds.hpp"

#include <functional>

namespace skein {

/// What leaves of one size cost and leaves of another, ns; see estimate_nanoseconds.
struct LeafCosts {
  double near_pair = 0.0;  ///< of nodes
  double far_pair = 0.0, box = 0.0;
  double far_node = 0.0;         ///< to and from expansions, where any boxes are far from each other
  double small_leaf_node = 0.0;  ///< more for a node than in leaves of the easy size

  bool operator==(const LeafCosts&) const = default;
};

/// What shapes a tree.
struct OctreeRules {
  int leaf_size = 64;                 ///< nodes per leaf to aim at, >= 1; in clouds up to twice as many
  double min_half_width = 0.0;        ///< no leaf is smaller, length
  double easy_half_width = 0.0;       ///< smaller leaves cost more by themselves: only where that pays. 0: none do
  LeafCosts costs;                    ///< by which that is decided
  bool has_quantized_cells = false;   ///< sides in steps, for operators that depend on them and are to be kept
  int min_sources_for_expansion = 0;  ///< fewer sources (or targets) than this are summed directly across W and X lists

  bool operator==(const OctreeRules&) const = default;
};

/// Cells that some sorted keys occupy: at each level those that begin there and not at a coarser level.
struct SampledCells {
  int n_keys = 0;
  int n_new_cells[max_key_depth + 1] = {1};
};

/// Level of the largest cells that tell two different keys of the full depth apart.
SKEIN_INLINE_FUNCTION int separating_level(const std::uint64_t one, const std::uint64_t other) {
  int level = max_key_depth + 1;
  for (std::uint64_t differ = one ^ other; differ != 0; differ >>= 3) --level;
  return level;
}

/// Counts the cells of every stride-th node.
using SampleCells = std::function<SampledCells(const KeyOf& key_of, int stride)>;

KeyOf make_key_of(const double (&corner)[3], double side, int depth);

/// The cube and the depth of its cells, from few numbers about the nodes. On the host for every space.
/// @param n_nodes  of those that are sampled: sources or targets, whichever are more
OctreeCube choose_octree_cube(NodeBounds bounds, int n_nodes, const OctreeRules& rules, const SampleCells& sample);

}  // namespace skein
