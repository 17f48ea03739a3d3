#pragma once

#include "fmm/octree.hpp"

#include <cstdint>

// How kernels split the boxes of a level.

namespace skein {

/// First place in [first, last) whose key belongs to an octant above `octant`.
template <class Keys>
KOKKOS_INLINE_FUNCTION int find_octant_end(const Keys& key, int first, int last, const int shift,
                                           const std::uint64_t octant) {
  while (first < last) {
    const int middle = first + (last - first) / 2;
    if ((key(middle) >> shift & 7) <= octant)
      first = middle + 1;
    else
      last = middle;
  }
  return first;
}

/// Where the nodes of a box's octants begin; octant 8 ends them.
struct OctantBounds {
  int source[9], target[9];
  KOKKOS_INLINE_FUNCTION IndexRange sources(const int octant) const {
    return {source[octant], source[octant + 1] - source[octant]};
  }
  KOKKOS_INLINE_FUNCTION IndexRange targets(const int octant) const {
    return {target[octant], target[octant + 1] - target[octant]};
  }
  KOKKOS_INLINE_FUNCTION bool has(const int octant) const {
    return sources(octant).count > 0 || targets(octant).count > 0;
  }
};

/// The boxes of one level, and how they are split.
template <class Space>
struct LevelBoxes {
  static constexpr int n_inner = 7;  ///< ends of octants that are not the box's

  Kokkos::View<Box*, Space> boxes;
  Kokkos::View<int*, Space> level_first;
  Kokkos::View<std::uint64_t*, Space> source_key, target_key;
  Kokkos::View<int*, Space> octant_end;  ///< of sources, n_inner to a box of the level, then of targets
  int level, n_most, split_above, shift;
  bool same_nodes;

  LevelBoxes(const Octree<Space>& tree, const int of_level, const int n_boxes_at_most)
      : boxes(tree.boxes),
        level_first(tree.marks),
        source_key(tree.sources.key),
        target_key(tree.targets.key),
        octant_end(tree.octant_end),
        level(of_level),
        n_most(n_boxes_at_most),
        split_above(tree.cube.split_above(of_level)),
        shift(3 * (tree.cube.max_depth - of_level - 1)),
        same_nodes(tree.same_nodes) {}

  /// Of the whole tree, that of the k-th of the level.
  KOKKOS_INLINE_FUNCTION int index(const int k) const { return level_first(level) + k; }
  /// False beyond the boxes of the level, all of them where they found no room.
  KOKKOS_INLINE_FUNCTION bool exists(const int k) const {
    const int end = level_first(level + 1);
    return index(k) < end && end <= boxes.extent_int(0);
  }
  KOKKOS_INLINE_FUNCTION bool is_split(const Box& box) const {
    return math::larger(box.sources.count, box.targets.count) > split_above;
  }
  KOKKOS_INLINE_FUNCTION bool is_split(const int k) const { return exists(k) && is_split(boxes(index(k))); }

  /// Searches for the end of one octant of the k-th box.
  KOKKOS_INLINE_FUNCTION void find_end(const int k, const int octant) const {
    if (!exists(k)) return;
    const Box& box = boxes(index(k));
    if (!is_split(box)) return;
    const auto bits = static_cast<std::uint64_t>(octant);
    octant_end(n_inner * k + octant) =
        find_octant_end(source_key, box.sources.first, box.sources.first + box.sources.count, shift, bits);
    if (!same_nodes)
      octant_end(n_inner * (n_most + k) + octant) =
          find_octant_end(target_key, box.targets.first, box.targets.first + box.targets.count, shift, bits);
  }

  /// Of a box that is split.
  KOKKOS_INLINE_FUNCTION OctantBounds bounds(const int k, const Box& box) const {
    OctantBounds bounds;
    bounds.source[0] = box.sources.first;
    bounds.target[0] = box.targets.first;
    for (int octant = 0; octant < n_inner; ++octant) {
      bounds.source[octant + 1] = octant_end(n_inner * k + octant);
      bounds.target[octant + 1] = octant_end(n_inner * (same_nodes ? k : n_most + k) + octant);
    }
    bounds.source[8] = box.sources.first + box.sources.count;
    bounds.target[8] = box.targets.first + box.targets.count;
    return bounds;
  }
  KOKKOS_INLINE_FUNCTION int count_children(const int k) const {
    if (!is_split(k)) return 0;
    const OctantBounds of_octants = bounds(k, boxes(index(k)));
    int n = 0;
    for (int octant = 0; octant < 8; ++octant) n += of_octants.has(octant);
    return n;
  }
};

/// What scans the children of a level's boxes: places in the order of all boxes, and where the level below ends.
template <class Space>
struct ScanChildren {
  LevelBoxes<Space> parents;
  Kokkos::View<int*, Space> first_child;

  KOKKOS_INLINE_FUNCTION void operator()(const int k, int& sum, const bool is_final) const {
    const int here = k < parents.n_most ? parents.count_children(k) : 0;
    if (is_final) first_child(k) = parents.level_first(parents.level + 1) + sum;
    if (is_final && k == parents.n_most) parents.level_first(parents.level + 2) = first_child(k);
    sum += here;
  }
};

}  // namespace skein
