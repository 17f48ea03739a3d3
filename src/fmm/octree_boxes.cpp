#include "fmm/octree.hpp"

#include <algorithm>

// The boxes of a tree, level by level, from sorted keys.

namespace skein {
namespace {

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

/// Splits the boxes of a level that hold enough nodes. @param n_most  boxes that the level may have
template <class Space>
void split_level(const Space& space, Octree<Space>& tree, const int level, const int n_most) {
  const auto n = static_cast<std::size_t>(n_most);
  require_extent(tree.count, n + 1, "skein::octree::box_count");
  require_extent(tree.octant_end, 2 * LevelBoxes<Space>::n_inner * n, "skein::octree::octant_end");
  const LevelBoxes<Space> parents(tree, level, n_most);
  launch<Space>(
      "skein::find_octants", space, Calls{LevelBoxes<Space>::n_inner * n_most, 15.0},
      KOKKOS_LAMBDA(const int i) { parents.find_end(i / LevelBoxes<Space>::n_inner, i % LevelBoxes<Space>::n_inner); });
  scan_each<Space>(space, 0, n_most, ScanChildren<Space>{parents, tree.count});
  if (!tree.defers_counts) {
    const int n_boxes = tree.read_marks(space, level + 3)(level + 2);
    if (n_boxes == tree.n_boxes()) return;
    extend(tree.boxes, static_cast<std::size_t>(n_boxes));
  }
  const auto first_child = tree.count;
  const auto boxes = tree.boxes;
  launch<Space>(
      "skein::split_boxes", space, Calls{n_most, 50.0}, KOKKOS_LAMBDA(const int k) {
        if (!parents.is_split(k) || parents.level_first(level + 2) > boxes.extent_int(0)) return;
        const int parent = parents.index(k);
        Box box = boxes(parent);
        const OctantBounds bounds = parents.bounds(k, box);
        box.first_child = first_child(k);
        box.n_children = first_child(k + 1) - first_child(k);
        int child = box.first_child;
        for (int octant = 0; octant < 8; ++octant)
          if (bounds.has(octant))
            boxes(child++) = make_child(box, parent, octant, bounds.sources(octant), bounds.targets(octant));
        boxes(parent) = box;
      });
}

/// Boxes that a level has at most: children of boxes with enough nodes to be split.
template <class Space>
int bound_boxes(const Octree<Space>& tree, const int level) {
  if (level < tree.n_levels()) return tree.level(level).count;
  const auto n_nodes = static_cast<std::int64_t>(tree.n_sources) + (tree.same_nodes ? 0 : tree.n_targets);
  const std::int64_t n_split = n_nodes / (tree.cube.split_above(level - 1) + 1);
  const std::int64_t n_cells = level < 7 ? std::int64_t{1} << 3 * level : n_nodes;
  return static_cast<int>(std::min({n_nodes, n_cells, 8 * n_split}));
}

/// So many levels are split before the next look at how many boxes there are: to the depth at which leaves are aimed
/// at, then a few at once.
template <class Space>
int choose_end(const Octree<Space>& tree, const int level) {
  if (!tree.defers_counts) return level + 1;
  return std::min(tree.cube.max_depth, std::max(tree.cube.aimed_depth + 1, level + 4));
}

/// Notes what is below levels [level, end), which were split; what found no room is left for the next time.
/// @returns true where a level has no boxes that were split: the tree is complete
template <class Space>
bool note_levels(const Space& space, Octree<Space>& tree, const int level, const int end) {
  const FoundNumbers& first = tree.read_marks(space, end + 2);
  for (int l = level; l < end; ++l) {
    const int n_boxes = first(l + 2);
    if (n_boxes == tree.n_boxes()) return true;
    if (n_boxes > tree.boxes.extent_int(0)) {
      extend(tree.boxes, static_cast<std::size_t>(n_boxes));
      return false;
    }
    tree.level_first.push_back(n_boxes);
  }
  return false;
}

}  // namespace

template <class Space>
void split_boxes(const Space& space, Octree<Space>& tree) {
  tree.require_marks();
  const auto n_cells =
      static_cast<std::size_t>(math::larger(tree.n_sources, tree.n_targets) / tree.cube.nodes_per_cell);
  extend(tree.boxes, tree.defers_counts ? 2 * n_cells + 64 : 1);
  const auto boxes = tree.boxes;
  const auto level_first = tree.marks;
  const int n_sources = tree.n_sources, n_targets = tree.n_targets;
  launch<Space>(
      "skein::make_root", space, Calls{1, 1.0}, KOKKOS_LAMBDA(const int i) {
        Box root;
        root.sources.count = n_sources;
        root.targets.count = n_targets;
        boxes(i) = root;
        level_first(0) = 0;
        level_first(1) = 1;
      });
  tree.level_first = {0, 1};
  for (int level = 0; level < tree.cube.max_depth; level = tree.n_levels() - 1) {
    const int end = choose_end(tree, level);
    for (int l = level; l < end; ++l) split_level(space, tree, l, bound_boxes(tree, l));
    if (note_levels(space, tree, level, end)) return;
  }
}

#define SKEIN_INSTANTIATE(S) template void split_boxes<S>(const S&, Octree<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
