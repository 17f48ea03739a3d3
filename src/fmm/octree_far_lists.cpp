#include "fmm/octree_walk.hpp"

namespace skein {
namespace {

/// Boxes of the same level that touch box b, and coarser leaves that do: among those that touch the parent and their
/// children.
template <class Space>
KOKKOS_INLINE_FUNCTION void list_touching(const ListSource<Space>& from, const int b, EntrySink<int>& touching) {
  const Box& box = from.boxes(b);
  if (b == 0) touching.add(0);
  if (b == 0) return;
  const IndexRange near_parent = from.touching_of(box.parent);
  for (int k = near_parent.first; k < near_parent.first + near_parent.count; ++k) {
    const int a = from.touching(k);
    const Box& other = from.boxes(a);
    if (other.is_leaf() && touch(box, other)) touching.add(a);
    for (int s = other.first_child; s < other.first_child + other.n_children; ++s)
      if (touch(box, from.boxes(s))) touching.add(s);
  }
}

/// Entries of one box. Transfers that are met are noted, too.
struct FarSinks {
  EntrySink<FarPair> far;
  EntrySink<int> coarse, x_direct;
  std::uint64_t met = 0;

  KOKKOS_INLINE_FUNCTION void add(const FarPair& pair) {
    far.add(pair);
    met |= std::uint64_t{1} << transfer_index(pair.transfer);
  }
};

/// V and X: among the boxes that touch the parent and their children, those that do not touch box b.
template <class Space>
KOKKOS_INLINE_FUNCTION void list_far(const ListSource<Space>& from, const int b, const int min_sources_for_expansion,
                                     FarSinks& sinks) {
  const Box& box = from.boxes(b);
  if (b == 0 || box.targets.count == 0) return;
  const bool is_cheap = box.is_leaf() && box.targets.count < min_sources_for_expansion;
  const IndexRange near_parent = from.touching_of(box.parent);
  for (int k = near_parent.first; k < near_parent.first + near_parent.count; ++k) {
    const int a = from.touching(k);
    const Box& other = from.boxes(a);
    if (other.is_leaf() && other.sources.count > 0 && !touch(box, other)) {
      if (is_cheap)
        sinks.x_direct.add(a);
      else
        sinks.coarse.add(a);
    }
    for (int s = other.first_child; s < other.first_child + other.n_children; ++s) {
      const Box& child = from.boxes(s);
      if (child.sources.count > 0 && !touch(box, child)) sinks.add(make_far_pair(b, s, box, child));
    }
  }
}

/// Level by level, because a box asks its parent's list.
template <class Space>
void build_touching(const Space& space, Octree<Space>& tree) {
  const auto n_boxes = static_cast<std::size_t>(tree.n_boxes());
  require_extent(tree.touching, most_touching * n_boxes, "skein::octree::touching");
  require_extent(tree.n_touching, n_boxes, "skein::octree::n_touching");
  const ListSource<Space> from(tree);
  const auto touching = tree.touching, n_touching = tree.n_touching;
  for (int level = 0; level < tree.n_levels(); ++level) {
    const IndexRange boxes = tree.level(level);
    launch<Space>(
        "skein::list_touching", space, Calls{boxes.count, 300.0}, KOKKOS_LAMBDA(const int k) {
          const int b = boxes.first + k;
          EntrySink<int> sink;
          sink.to = touching.data() + most_touching * b;
          list_touching(from, b, sink);
          n_touching(b) = sink.n;
        });
  }
}

template <class Space>
void build_far(const Space& space, Octree<Space>& tree, const int min_sources_for_expansion) {
  const int n_boxes = tree.n_boxes();
  const auto n_first = static_cast<std::size_t>(n_boxes) + 1;
  require_extent(tree.v_list.first, n_first, "skein::octree::v_first");
  require_extent(tree.x_list.first, n_first, "skein::octree::x_first");
  require_extent(tree.x_direct.first, n_first, "skein::octree::x_direct_first");
  const ListSource<Space> from(tree);
  const auto far_first = tree.v_list.first, coarse_first = tree.x_list.first, direct_first = tree.x_direct.first;
  launch_reduction<Space>(
      "skein::count_far", space, Calls{n_boxes, 500.0},
      KOKKOS_LAMBDA(const int b, std::uint64_t& met) {
        FarSinks sinks;
        list_far(from, b, min_sources_for_expansion, sinks);
        far_first(b) = sinks.far.n;
        coarse_first(b) = sinks.coarse.n;
        direct_first(b) = sinks.x_direct.n;
        met |= sinks.met;
      },
      Kokkos::BOr<std::uint64_t, SharedHostMemory>(tree.totals.transfers));
  place_lists(space, tree, n_boxes, FoundTotals::v, tree.v_list, tree.x_list, tree.x_direct);
  const auto far = tree.v_list;
  const auto coarse = tree.x_list, x_direct = tree.x_direct;
  launch<Space>(
      "skein::list_far", space, Calls{n_boxes, 500.0}, KOKKOS_LAMBDA(const int b) {
        FarSinks sinks;
        if (far.has_room(n_boxes)) sinks.far.to = far.entries.data() + far.first(b);
        if (coarse.has_room(n_boxes)) sinks.coarse.to = coarse.entries.data() + coarse.first(b);
        if (x_direct.has_room(n_boxes)) sinks.x_direct.to = x_direct.entries.data() + x_direct.first(b);
        list_far(from, b, min_sources_for_expansion, sinks);
      });
}

}  // namespace

template <class Space>
void build_far_lists(const Space& space, Octree<Space>& tree) {
  build_touching(space, tree);
  build_far(space, tree, tree.rules.min_sources_for_expansion);
}

#define SKEIN_INSTANTIATE(S) template void build_far_lists<S>(const S&, Octree<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
