#include <skein/core/error.hpp>

#include "fmm/octree_walk.hpp"
#include "fmm/tree_fit.hpp"
#include "kernels/node_checks.hpp"

#include <algorithm>
#include <utility>

namespace skein {
namespace {

/// After a wait. False where lists found no room, which there is now.
template <class Space>
bool take_totals(Octree<Space>& tree) {
  const FoundTotals& totals = tree.totals;
  tree.n_target_leaves = totals.n_target_leaves();
  tree.largest_leaf = tree.n_target_leaves > 0 ? tree.half_width(totals.coarsest_leaf()) : 0.0;
  tree.n_near_pairs = static_cast<double>(totals.near_pairs());
  tree.transfers = totals.transfers();
  const FoundNumbers& n = totals.entries;
  const bool had_room[] = {take_room(tree.v_list, n(FoundTotals::v)), take_room(tree.x_list, n(FoundTotals::x)),
                           take_room(tree.x_direct, n(FoundTotals::x_direct)),
                           take_room(tree.u_list, n(FoundTotals::u)), take_room(tree.w_list, n(FoundTotals::w))};
  return std::find(std::begin(had_room), std::end(had_room), false) == std::end(had_room);
}

}  // namespace

template <class Space>
void build_lists(const Space& space, Octree<Space>& tree) {
  do {
    build_far_lists(space, tree);
    build_near_lists(space, tree);
    wait_for(space);
  } while (!take_totals(tree));
}

template <class Space>
void Octree<Space>::build(const Space& space, const ConstVectorView<Space>& source,
                          const ConstVectorView<Space>& target, const NodeBounds& bounds, const OctreeRules& shape) {
  SKEIN_REQUIRE(shape.leaf_size >= 1, "a leaf holds at least one node");
  rules = shape;
  n_sources = source.extent_int(0);
  n_targets = target.extent_int(0);
  same_nodes = are_same_nodes(source, target);
  n_strays() = 0;
  cube = choose_cube<Space>(space, *this, source, target, bounds);
  const KeyOf key_of = make_key_of(cube.corner, cube.side, cube.max_depth);
  const auto sort = [&](const ConstVectorView<Space>& nodes, KeyedOrder<Space>& keyed) {
    keyed.require(nodes.extent(0));
    make_keys<Space>(space, nodes, key_of, 1, keyed);
    sort_by_key(space, keyed, nodes.extent_int(0), 3 * cube.max_depth, sort_memory);
  };
  sort(source, sources);
  if (!same_nodes) sort(target, targets);
  split_boxes(space, *this);
  build_lists(space, *this);
}

template <class Space>
void Octree<Space>::build(const Space& space, const ConstVectorView<Space>& source,
                          const ConstVectorView<Space>& target, const OctreeRules& shape) {
  build(space, source, target, take_census<Space>(space, source, target, {}).bounds, shape);
}

template <class Space>
void Octree<Space>::ask_whether_it_fits(const Space& space, const ConstVectorView<Space>& source,
                                        const ConstVectorView<Space>& target) const {
  if (source.extent_int(0) != n_sources || target.extent_int(0) != n_targets ||
      are_same_nodes(source, target) != same_nodes) {
    n_strays() = 1;
    return;
  }
  seek_strays<Space>(space, Kokkos::subview(boxes, std::make_pair(0, n_boxes())), cube, {source, sources.order},
                     same_nodes ? TreeNodes<Space>() : TreeNodes<Space>{target, targets.order}, n_strays);
}

template <class Space>
void Octree<Space>::drop_keys() {
  sources.key = targets.key = {};
  sort_memory = {};
  octant_end = {};
}

template <class Space>
double Octree<Space>::bytes() const {
  const double n_ints =
      static_cast<double>(target_leaves.extent(0) + near_end.extent(0) + count.extent(0) + sort_memory.place.extent(0) +
                          touching.extent(0) + n_touching.extent(0) + octant_end.extent(0));
  return sources.bytes() + targets.bytes() + sort_memory.spare.bytes() + 4.0 * n_ints +
         static_cast<double>(boxes.extent(0) * sizeof(Box)) + u_list.bytes() + w_list.bytes() + v_list.bytes() +
         x_list.bytes() + x_direct.bytes();
}

#define SKEIN_INSTANTIATE(S)                                                                                          \
  template void build_lists<S>(const S&, Octree<S>&);                                                                 \
  template void Octree<S>::build(const S&, const ConstVectorView<S>&, const ConstVectorView<S>&, const NodeBounds&,   \
                                 const OctreeRules&);                                                                 \
  template void Octree<S>::build(const S&, const ConstVectorView<S>&, const ConstVectorView<S>&, const OctreeRules&); \
  template void Octree<S>::ask_whether_it_fits(const S&, const ConstVectorView<S>&, const ConstVectorView<S>&) const; \
  template void Octree<S>::drop_keys();                                                                               \
  template double Octree<S>::bytes() const;
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
