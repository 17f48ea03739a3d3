#pragma once

#include <skein/core/math.hpp>
#include <skein/core/vec3.hpp>

#include "fmm/morton_key.hpp"
#include "kernels/index_range.hpp"

// What the octrees of hosts and of devices have in common.

namespace skein {

/// A cube of the tree. Boxes without nodes do not exist; a box may hold sources only or targets only.
struct Box {
  int level = 0;
  int parent = -1;
  int first_child = 0;
  int n_children = 0;           ///< 0: a leaf; -1: it has some, of which only another rank knows
  int octant = 0;               ///< in the parent: bit c is set on the upper side of axis c
  int cell[3] = {};             ///< position in the grid of its level
  IndexRange sources, targets;  ///< in the order of the tree
  SKEIN_INLINE_FUNCTION bool is_leaf() const { return n_children == 0; }
};

/// @param sources, targets  of the octant
SKEIN_INLINE_FUNCTION Box make_child(const Box& parent, const int parent_index, const int octant,
                                     const IndexRange sources, const IndexRange targets) {
  Box child;
  child.level = parent.level + 1;
  child.parent = parent_index;
  child.octant = octant;
  for (int c = 0; c < 3; ++c) child.cell[c] = 2 * parent.cell[c] + (octant >> c & 1);
  child.sources = sources;
  child.targets = targets;
  return child;
}

/// A pair of the V lists: boxes of one level that do not touch, while their parents do.
struct FarPair {
  int target = 0, source = 0;
  signed char transfer[3] = {};  ///< source cell - target cell, -3 .. 3
};

SKEIN_INLINE_FUNCTION FarPair make_far_pair(const int target, const int source, const Box& at, const Box& from) {
  FarPair pair;
  pair.target = target;
  pair.source = source;
  for (int c = 0; c < 3; ++c) pair.transfer[c] = static_cast<signed char>(from.cell[c] - at.cell[c]);
  return pair;
}

/// One number for a transfer vector and all its mirror images, below 64.
SKEIN_INLINE_FUNCTION int transfer_index(const signed char (&t)[3]) {
  int index = 0;
  for (int c = 0; c < 3; ++c) index += (t[c] < 0 ? -t[c] : t[c]) << 2 * c;
  return index;
}
/// Which axes of a transfer vector are mirrored: bit c for axis c.
SKEIN_INLINE_FUNCTION int reflected_axes(const signed char (&t)[3]) {
  return (t[0] < 0) + 2 * (t[1] < 0) + 4 * (t[2] < 0);
}

/// One axis of the way from a parent's centre to a child's, in the child's half-widths: 1 or -1.
SKEIN_INLINE_FUNCTION int child_side(const int octant, const int axis) { return (octant >> axis & 1) != 0 ? 1 : -1; }

/// True where two boxes share a point.
SKEIN_INLINE_FUNCTION bool touch(const Box& a, const Box& b) {
  const Box& coarse = a.level < b.level ? a : b;
  const Box& fine = a.level < b.level ? b : a;
  const int levels = fine.level - coarse.level;
  for (int c = 0; c < 3; ++c) {
    const int low = coarse.cell[c] << levels, high = (coarse.cell[c] + 1) << levels;
    if (fine.cell[c] + 1 < low || fine.cell[c] > high) return false;
  }
  return true;
}

/// Cell of a coordinate; what lies outside the cube, or is not a number, goes to a cell at its rim.
SKEIN_INLINE_FUNCTION std::uint64_t cell_of(const double x, const double corner, const double cells_per_length,
                                            const double n_cells) {
  const double cell = (x - corner) * cells_per_length;
  if (!(cell > 0.0)) return 0;
  return static_cast<std::uint64_t>(cell < n_cells ? cell : n_cells - 1.0);
}

/// Morton keys of nodes in the cells of one depth.
struct KeyOf {
  double corner[3];
  double cells_per_length, n_cells;
  template <class Nodes>
  SKEIN_INLINE_FUNCTION std::uint64_t operator()(const Nodes& nodes, const int i) const {
    return morton_key(cell_of(nodes(i, 0), corner[0], cells_per_length, n_cells),
                      cell_of(nodes(i, 1), corner[1], cells_per_length, n_cells),
                      cell_of(nodes(i, 2), corner[2], cells_per_length, n_cells));
  }
};

/// Where the root of a tree lies and how far it is divided.
struct OctreeCube {
  double corner[3] = {};
  double side = 1.0;
  int max_depth = 0;
  int aimed_depth = 0;  ///< where leaves hold about leaf_size nodes; smaller boxes are split only when they hold more
  int nodes_per_cell = 0;

  SKEIN_INLINE_FUNCTION Vec3 center(const Box& box) const {
    const double side_of_box = side / static_cast<double>(1 << box.level);
    return {corner[0] + (box.cell[0] + 0.5) * side_of_box, corner[1] + (box.cell[1] + 0.5) * side_of_box,
            corner[2] + (box.cell[2] + 0.5) * side_of_box};
  }
  SKEIN_INLINE_FUNCTION double half_width(const int level) const {
    return 0.5 * side / static_cast<double>(1 << level);
  }
  /// A box of a level is split where it holds more sources or targets: above the aimed depth more than a leaf's worth,
  /// below several.
  int split_above(const int level) const {
    return level + 1 <= aimed_depth ? (nodes_per_cell * 5) / 4 : 3 * nodes_per_cell;
  }
};

}  // namespace skein
