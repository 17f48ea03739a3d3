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
        direct(tree.x_direct.entries) {}

  Kokkos::View<const Box*, Space> boxes;
  Kokkos::View<const int*, Space> touching, n_touching, direct_first, direct;

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
  for (int k = from.direct_first(leaf); k < from.direct_first(leaf + 1); ++k)
    visitor.near(from.direct(k), from.boxes(from.direct(k)));
}

/// Some numbers from arrays to one.
template <class Space, int n>
struct GatherTotals {
  Kokkos::View<int*, Space> from[n];
  int at[n];
  Kokkos::View<int*, Space> to;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const { to(i) = from[i](at[i]); }
};

/// The arrays for entries of some lists, whose counts are in lists.first(0) .. lists.first(n - 1): one wait for all.
template <class Space, class... Lists>
void place_lists(const Space& space, Octree<Space>& tree, const int n, const char* label, Lists&... lists) {
  constexpr int n_lists = sizeof...(Lists);
  require_extent(tree.totals, n_lists, "skein::octree::totals");
  (scan_in_place(space, lists.first, n), ...);
  GatherTotals<Space, n_lists> gather{{lists.first...}, {}, tree.totals};
  for (int& at : gather.at) at = n;
  Kokkos::parallel_for("skein::gather_totals", Kokkos::RangePolicy<Space>(space, 0, n_lists), gather);
  space.fence();
  const auto totals = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), tree.totals);
  int i = 0;
  ((lists.n_entries = totals(i++)), ...);
  (require_extent(lists.entries, static_cast<std::size_t>(lists.n_entries), label), ...);
}

}  // namespace skein
