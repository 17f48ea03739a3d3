#pragma once

#include "fmm/device_octree.hpp"

// Every list is made twice by the same code: first counted, then written where a scan of the counts has put it.

namespace skein {

/// What the lists are made from, by value for kernels.
template <class Space>
struct ListSource {
  explicit ListSource(const DeviceOctree<Space>& tree)
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
void place_lists(const Space& space, DeviceOctree<Space>& tree, const int n, const char* label, Lists&... lists) {
  constexpr int n_lists = sizeof...(Lists);
  require_extent(tree.totals, n_lists, "skein::device_list_source::totals");
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
