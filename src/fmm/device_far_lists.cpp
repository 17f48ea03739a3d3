#include "fmm/device_list_source.hpp"

namespace skein {
namespace {

/// Boxes of the same level that touch box b, and coarser leaves that do: among those that touch the parent and their
/// children.
template <class Space>
KOKKOS_INLINE_FUNCTION void list_touching(const ListSource<Space>& from, const int b, EntrySink<int>& touching) {
  const Box box = from.boxes(b);
  if (b == 0) touching.add(0);
  if (b == 0) return;
  for (int k = from.touching_first(box.parent); k < from.touching_first(box.parent + 1); ++k) {
    const int a = from.touching(k);
    const Box other = from.boxes(a);
    if (other.is_leaf() && touch(box, other)) touching.add(a);
    for (int s = other.first_child; s < other.first_child + other.n_children; ++s)
      if (touch(box, from.boxes(s))) touching.add(s);
  }
}

struct FarSinks {
  EntrySink<FarPair> far;
  EntrySink<int> coarse, x_direct;
};

/// V and X: among the boxes that touch the parent and their children, those that do not touch box b.
template <class Space>
KOKKOS_INLINE_FUNCTION void list_far(const ListSource<Space>& from, const int b, const int min_sources_for_expansion,
                                     FarSinks& sinks) {
  const Box box = from.boxes(b);
  if (b == 0 || box.targets.count == 0) return;
  const bool is_cheap = box.is_leaf() && box.targets.count < min_sources_for_expansion;
  for (int k = from.touching_first(box.parent); k < from.touching_first(box.parent + 1); ++k) {
    const int a = from.touching(k);
    const Box other = from.boxes(a);
    if (other.is_leaf() && other.sources.count > 0 && !touch(box, other)) {
      if (is_cheap)
        sinks.x_direct.add(a);
      else
        sinks.coarse.add(a);
    }
    for (int s = other.first_child; s < other.first_child + other.n_children; ++s) {
      const Box child = from.boxes(s);
      if (child.sources.count > 0 && !touch(box, child)) sinks.far.add(make_far_pair(b, s, box, child));
    }
  }
}

/// Level by level, because a box asks its parent's list.
template <class Space>
void build_touching(const Space& space, DeviceOctree<Space>& tree) {
  auto& lists = tree.touching;
  const auto n_first = static_cast<std::size_t>(tree.n_boxes()) + 1;
  require_extent(lists.first, n_first, "skein::device_far_lists::touching_first");
  require_extent(tree.count, n_first, "skein::device_far_lists::box_count");
  Kokkos::deep_copy(space, lists.first, 0);
  lists.n_entries = 0;
  const auto count = tree.count;
  for (int level = 0; level < tree.n_levels(); ++level) {
    const IndexRange boxes = tree.level(level);
    for (const bool fills : {false, true}) {
      const ListSource<Space> from(tree);
      const auto first = lists.first;
      const auto entries = lists.entries;
      Kokkos::parallel_for(
          "skein::list_touching", Kokkos::RangePolicy<Space>(space, 0, boxes.count), KOKKOS_LAMBDA(const int k) {
            const int b = boxes.first + k;
            EntrySink<int> sink;
            if (fills) sink.to = entries.data() + count(k);
            list_touching(from, b, sink);
            if (fills)
              first(b + 1) = count(k + 1);
            else
              count(k) = sink.n;
          });
      if (fills) continue;
      lists.n_entries = scan_counts(space, tree.count, 0, boxes.count, lists.n_entries);
      extend(lists.entries, static_cast<std::size_t>(lists.n_entries));
    }
  }
}

template <class Space>
void build_far(const Space& space, DeviceOctree<Space>& tree, const int min_sources_for_expansion) {
  const int n_boxes = tree.n_boxes();
  const auto n_first = static_cast<std::size_t>(n_boxes) + 1;
  require_extent(tree.v_list.first, n_first, "skein::device_far_lists::v_first");
  require_extent(tree.x_list.first, n_first, "skein::device_far_lists::x_first");
  require_extent(tree.x_direct.first, n_first, "skein::device_far_lists::x_direct_first");
  for (const bool fills : {false, true}) {
    const ListSource<Space> from(tree);
    const auto far = tree.v_list;
    const auto coarse = tree.x_list, x_direct = tree.x_direct;
    Kokkos::parallel_for(
        "skein::list_far", Kokkos::RangePolicy<Space>(space, 0, n_boxes), KOKKOS_LAMBDA(const int b) {
          FarSinks sinks;
          if (fills) {
            sinks.far.to = far.entries.data() + far.first(b);
            sinks.coarse.to = coarse.entries.data() + coarse.first(b);
            sinks.x_direct.to = x_direct.entries.data() + x_direct.first(b);
          }
          list_far(from, b, min_sources_for_expansion, sinks);
          if (!fills) {
            far.first(b) = sinks.far.n;
            coarse.first(b) = sinks.coarse.n;
            x_direct.first(b) = sinks.x_direct.n;
          }
        });
    if (fills) continue;
    place_lists(space, tree.v_list, n_boxes, "skein::device_far_lists::v_list");
    place_lists(space, tree.x_list, n_boxes, "skein::device_far_lists::x_list");
    place_lists(space, tree.x_direct, n_boxes, "skein::device_far_lists::x_direct");
  }
  const auto pairs = tree.v_list.entries;
  Kokkos::parallel_reduce(
      "skein::find_transfers_met", Kokkos::RangePolicy<Space>(space, 0, tree.v_list.n_entries),
      KOKKOS_LAMBDA(const int k, std::uint64_t& met) { met |= std::uint64_t{1} << transfer_index(pairs(k).transfer); },
      Kokkos::BOr<std::uint64_t>(tree.transfers));
}

}  // namespace

template <class Space>
void build_far_lists(const Space& space, DeviceOctree<Space>& tree, const OctreeRules& rules) {
  build_touching(space, tree);
  build_far(space, tree, rules.min_sources_for_expansion);
}

#define SKEIN_INSTANTIATE(S) template void build_far_lists<S>(const S&, DeviceOctree<S>&, const OctreeRules&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
