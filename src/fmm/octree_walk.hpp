#pragma once

#include "fmm/octree.hpp"

// Every list is made twice by the same code: first counted, then written where a scan of the counts has put it.

namespace skein {

/// What the lists are made from, by value for kernels.
template <class Space>
struct ListSource {
  explicit ListSource(const Octree<Space>& tree)
      : boxes(tree.boxes),
        touching(tree.touching),
        n_touching(tree.n_touching),
        direct_first(tree.x_direct.first),
        direct(tree.x_direct.entries),
        n_boxes(tree.n_boxes()) {}

  Kokkos::View<const Box*, Space> boxes;
  Kokkos::View<const int*, Space> touching, n_touching, direct_first, direct;
  int n_boxes;

  /// The places in `touching` of what touches a box.
  KOKKOS_INLINE_FUNCTION IndexRange touching_of(const int box) const { return {most_touching * box, n_touching(box)}; }
};

/// The box that follows in a walk through everything below `root`, which leaves out what is below `box`; root at the
/// end. Boxes have no siblings but their parent's children, which stand together.
template <class Space>
KOKKOS_INLINE_FUNCTION int next_box(const ListSource<Space>& from, int box, const int root) {
  while (box != root) {
    const int parent = from.boxes(box).parent;
    if (box + 1 < from.boxes(parent).first_child + from.boxes(parent).n_children) return box + 1;
    box = parent;
  }
  return root;
}

/// U and W: down from every box that touches the leaf. visitor.near(b, box) for boxes whose sources the leaf meets one
/// by one, visitor.fine(b) for those of which it needs the expansion.
template <class Space, class Visitor>
KOKKOS_INLINE_FUNCTION void visit_near(const ListSource<Space>& from, const int leaf,
                                       const int min_sources_for_expansion, Visitor& visitor) {
  const Box& box = from.boxes(leaf);
  const IndexRange around = from.touching_of(leaf);
  for (int k = around.first; k < around.first + around.count; ++k) {
    const int root = from.touching(k);
    int b = root;
    do {
      const Box& other = from.boxes(b);
      bool goes_down = false;
      if (other.sources.count > 0) {
        if (!touch(box, other)) {
          if (other.sources.count < min_sources_for_expansion)
            visitor.near(b, other);
          else
            visitor.fine(b);
        } else if (other.is_leaf()) {
          visitor.near(b, other);
        } else {
          goes_down = true;
        }
      }
      b = goes_down ? other.first_child : next_box(from, b, root);
    } while (b != root);
  }
  if (from.direct_first(from.n_boxes) > from.direct.extent_int(0)) return;  // they found no room, and all is made again
  for (int k = from.direct_first(leaf); k < from.direct_first(leaf + 1); ++k)
    visitor.near(from.direct(k), from.boxes(from.direct(k)));
}

/// Where the entries of some lists end, from their arrays to one.
template <class Space, int n_lists>
struct GatherTotals {
  Kokkos::View<int*, Space> first[n_lists];
  int end;
  FoundNumbers to;
  int at;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const { to(at + i) = first[i](end); }
};

/// Room for as many entries as there are. False where there was less.
template <class Entry, class Space>
bool take_room(Lists<Entry, Space>& lists, const int n_entries) {
  const bool had_room = n_entries <= lists.entries.extent_int(0);
  lists.n_entries = n_entries;
  require_extent(lists.entries, static_cast<std::size_t>(n_entries), "skein::octree::list");
  return had_room;
}

/// Turns the counts of some lists, lists.first(0) .. lists.first(n - 1), into places. Where the tree does not defer it,
/// waits for them and makes room.
/// @param at  in tree.totals.entries
template <class Space, class... Lists>
void place_lists(const Space& space, const Octree<Space>& tree, const int n, const int at, Lists&... lists) {
  constexpr int n_lists = sizeof...(Lists);
  (scan_in_place(space, lists.first, n), ...);
  const FoundNumbers& found = tree.totals.entries;
  launch<Space>("skein::gather_totals", space, Calls{n_lists, 1.0},
                GatherTotals<Space, n_lists>{{lists.first...}, n, found, at});
  if (tree.defers_counts) return;
  wait_for(space);
  int i = at;
  (take_room(lists, found(i++)), ...);
}

/// The parts of build_lists: touching boxes, V and X ...
template <class Space>
void build_far_lists(const Space& space, Octree<Space>& tree);
/// ... then leaves with targets, U and W.
template <class Space>
void build_near_lists(const Space& space, Octree<Space>& tree);

}  // namespace skein
