#include "fmm/level_boxes.hpp"

#include <algorithm>

// Where the root of a tree lies and how far it is divided, from bounds and a sample of the nodes; keys of the nodes;
// and from sorted keys the boxes, level by level.

namespace skein {
namespace {

template <class Space>
using Nodes = ConstVectorView<Space>;

template <class Space>
SampledCells sample_cells(const Space& space, const Nodes<Space>& nodes, const KeyOf& key_of, const int stride,
                          Octree<Space>& tree) {
  constexpr int n_levels = max_key_depth + 1;
  SampledCells cells;
  cells.n_keys = math::ceil_div(nodes.extent_int(0), stride);
  tree.sources.require(static_cast<std::size_t>(cells.n_keys));
  make_keys<Space>(space, nodes, key_of, stride, tree.sources);
  sort_by_key(space, tree.sources, cells.n_keys, 3 * max_key_depth, tree.sort_memory);
  tree.require_marks();
  const auto n_new = tree.marks;
  Kokkos::deep_copy(space, n_new, 0);
  const auto key = tree.sources.key;
  Kokkos::parallel_for(
      "skein::sample_cells", Kokkos::RangePolicy<Space>(space, 1, math::larger(1, cells.n_keys)),
      KOKKOS_LAMBDA(const int i) {
        if (key(i) != key(i - 1)) Kokkos::atomic_add(&n_new(separating_level(key(i), key(i - 1))), 1);
      });
  const FoundNumbers& found = tree.read_marks(space, n_levels);
  for (int level = 1; level < n_levels; ++level) cells.n_new_cells[level] = found(level);
  return cells;
}

/// Splits the boxes of a level that hold enough nodes. @param n_most  boxes that the level may have
template <class Space>
void split_level(const Space& space, Octree<Space>& tree, const int level, const int n_most) {
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

/// What splitting levels [level, end) needs: before the first of them, so that no array is let go while kernels have
/// it.
template <class Space>
void require_counts(Octree<Space>& tree, const int level, const int end) {
  int n_most = 0;
  for (int l = level; l < end; ++l) n_most = math::larger(n_most, bound_boxes(tree, l));
  const auto n = static_cast<std::size_t>(n_most);
  require_extent(tree.count, n + 1, "skein::octree::box_count");
  require_extent(tree.octant_end, 2 * LevelBoxes<Space>::n_inner * n, "skein::octree::octant_end");
}

/// Notes what is below levels [level, end), which were split; what found no room is left for the next time.
/// @returns true where a level has no boxes that were split: the tree is complete
template <class Space>
bool note_levels(const Space& space, Octree<Space>& tree, const int level, const int end) {
  const FoundNumbers& first = tree.defers_counts ? tree.read_marks(space, end + 2) : tree.found;
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
void make_keys(const Space& space, const ConstVectorView<Space>& nodes, const KeyOf& key_of, const int stride,
               const KeyedOrder<Space>& keyed) {
  const auto key = keyed.key;
  const auto order = keyed.order;
  launch<Space>(
      "skein::make_morton_keys", space, Calls{math::ceil_div(nodes.extent_int(0), stride), 6.0},
      KOKKOS_LAMBDA(const int i) {
        key(i) = key_of(nodes, i * stride);
        order(i) = i;
      });
}

template <class Space>
OctreeCube choose_cube(const Space& space, Octree<Space>& tree, const ConstVectorView<Space>& source,
                       const ConstVectorView<Space>& target, const NodeBounds& bounds) {
  const Nodes<Space>& more = source.extent(0) >= target.extent(0) ? source : target;
  return choose_octree_cube(bounds, more.extent_int(0), tree.rules, [&](const KeyOf& key_of, const int stride) {
    return sample_cells<Space>(space, more, key_of, stride, tree);
  });
}

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
    require_counts(tree, level, end);
    for (int l = level; l < end; ++l) split_level(space, tree, l, bound_boxes(tree, l));
    if (note_levels(space, tree, level, end)) return;
  }
}

#define SKEIN_INSTANTIATE(S)                                                                                     \
  template void make_keys<S>(const S&, const ConstVectorView<S>&, const KeyOf&, int, const KeyedOrder<S>&);      \
  template OctreeCube choose_cube<S>(const S&, Octree<S>&, const ConstVectorView<S>&, const ConstVectorView<S>&, \
                                     const NodeBounds&);                                                         \
  template void split_boxes<S>(const S&, Octree<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
