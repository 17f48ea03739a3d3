#include "fmm/octree.hpp"

#include <skein/core/error.hpp>

#include "fmm/tree_fit.hpp"
#include "kernels/node_checks.hpp"

#include <utility>

namespace skein {
namespace {

template <class Space>
using Nodes = ConstVectorView<Space>;

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

template <class Keys>
KOKKOS_INLINE_FUNCTION OctantBounds find_octants(const Keys& source_key, const Keys& target_key, const bool same_nodes,
                                                 const Box& box, const int shift) {
  OctantBounds bounds;
  bounds.source[0] = box.sources.first;
  bounds.target[0] = box.targets.first;
  const int last_source = box.sources.first + box.sources.count, last_target = box.targets.first + box.targets.count;
  for (int octant = 0; octant < 8; ++octant) {
    const auto bits = static_cast<std::uint64_t>(octant);
    bounds.source[octant + 1] = find_octant_end(source_key, bounds.source[octant], last_source, shift, bits);
    bounds.target[octant + 1] = same_nodes
                                    ? bounds.source[octant + 1]
                                    : find_octant_end(target_key, bounds.target[octant], last_target, shift, bits);
  }
  return bounds;
}

/// The boxes below one level, in the order of their parents and octants.
template <class Space>
void split_level(const Space& space, Octree<Space>& tree, const int level) {
  const IndexRange parents = tree.level(level);
  const int shift = 3 * (tree.cube.max_depth - level - 1), split_above = tree.cube.split_above(level);
  const bool same_nodes = tree.same_nodes;
  const auto source_key = tree.sources.key, target_key = same_nodes ? tree.sources.key : tree.targets.key;
  require_extent(tree.count, static_cast<std::size_t>(parents.count) + 1, "skein::octree::box_count");
  const auto count = tree.count;
  const auto parent_boxes = tree.boxes;
  launch<Space>(
      "skein::count_children", space, Calls{parents.count, 100.0}, KOKKOS_LAMBDA(const int k) {
        const Box box = parent_boxes(parents.first + k);
        int n = 0;
        if (math::larger(box.sources.count, box.targets.count) > split_above) {
          const OctantBounds bounds = find_octants(source_key, target_key, same_nodes, box, shift);
          for (int octant = 0; octant < 8; ++octant) n += bounds.has(octant);
        }
        count(k) = n;
      });
  const int first_child = tree.n_boxes();
  const int n_boxes = scan_counts(space, tree.count, 0, parents.count, first_child);
  if (n_boxes == first_child) return;
  extend(tree.boxes, static_cast<std::size_t>(n_boxes));
  const auto boxes = tree.boxes;
  launch<Space>(
      "skein::split_boxes", space, Calls{parents.count, 100.0}, KOKKOS_LAMBDA(const int k) {
        if (count(k + 1) == count(k)) return;
        const int parent = parents.first + k;
        Box box = boxes(parent);
        const OctantBounds bounds = find_octants(source_key, target_key, same_nodes, box, shift);
        box.first_child = count(k);
        box.n_children = count(k + 1) - count(k);
        int child = box.first_child;
        for (int octant = 0; octant < 8; ++octant)
          if (bounds.has(octant))
            boxes(child++) = make_child(box, parent, octant, bounds.sources(octant), bounds.targets(octant));
        boxes(parent) = box;
      });
  tree.level_first.push_back(n_boxes);
}

template <class Space>
void split_boxes(const Space& space, Octree<Space>& tree) {
  extend(tree.boxes, 1);
  const auto boxes = tree.boxes;
  const int n_sources = tree.n_sources, n_targets = tree.n_targets;
  launch<Space>(
      "skein::make_root", space, Calls{1, 1.0}, KOKKOS_LAMBDA(const int i) {
        Box root;
        root.sources.count = n_sources;
        root.targets.count = n_targets;
        boxes(i) = root;
      });
  tree.level_first = {0, 1};
  for (int level = 0; level < tree.cube.max_depth && tree.n_levels() == level + 1; ++level)
    split_level(space, tree, level);
}

}  // namespace

template <class Space>
void Octree<Space>::build(const Space& space, const ConstVectorView<Space>& source,
                          const ConstVectorView<Space>& target, const OctreeRules& shape) {
  SKEIN_REQUIRE(shape.leaf_size >= 1, "a leaf holds at least one node");
  rules = shape;
  n_sources = source.extent_int(0);
  n_targets = target.extent_int(0);
  same_nodes = are_same_nodes(source, target);
  cube = choose_cube<Space>(space, *this, source, target);
  const KeyOf key_of = make_key_of(cube.corner, cube.side, cube.max_depth);
  const auto sort = [&](const Nodes<Space>& nodes, KeyedOrder<Space>& keyed) {
    keyed.require(nodes.extent(0));
    make_keys<Space>(space, nodes, key_of, 1, keyed);
    sort_by_key(space, keyed, nodes.extent_int(0), 3 * cube.max_depth, sort_memory);
  };
  sort(source, sources);
  if (!same_nodes) sort(target, targets);
  split_boxes(space, *this);
  build_far_lists(space, *this);
  build_near_lists(space, *this);
}

template <class Space>
bool Octree<Space>::still_fits(const Space& space, const ConstVectorView<Space>& source,
                               const ConstVectorView<Space>& target) const {
  if (source.extent_int(0) != n_sources || target.extent_int(0) != n_targets ||
      are_same_nodes(source, target) != same_nodes)
    return false;
  return nodes_fit<Space>(space, Kokkos::subview(boxes, std::make_pair(0, n_boxes())), cube, {source, sources.order},
                          same_nodes ? TreeNodes<Space>() : TreeNodes<Space>{target, targets.order});
}

template <class Space>
void Octree<Space>::drop_keys() {
  sources.key = targets.key = {};
  sort_memory = {};
}

template <class Space>
double Octree<Space>::bytes() const {
  const double n_ints = static_cast<double>(target_leaves.extent(0) + near_end.extent(0) + count.extent(0) +
                                            sort_memory.place.extent(0) + touching.extent(0) + n_touching.extent(0));
  return sources.bytes() + targets.bytes() + sort_memory.spare.bytes() + 4.0 * n_ints +
         static_cast<double>(boxes.extent(0) * sizeof(Box)) + u_list.bytes() + w_list.bytes() + v_list.bytes() +
         x_list.bytes() + x_direct.bytes();
}

#define SKEIN_INSTANTIATE(S)                                                                                          \
  template void Octree<S>::build(const S&, const ConstVectorView<S>&, const ConstVectorView<S>&, const OctreeRules&); \
  template bool Octree<S>::still_fits(const S&, const ConstVectorView<S>&, const ConstVectorView<S>&) const;          \
  template void Octree<S>::drop_keys();                                                                               \
  template double Octree<S>::bytes() const;
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
