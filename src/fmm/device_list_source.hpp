#pragma once

#include "fmm/device_octree.hpp"

// Every list is made twice by the same code: first counted, then written where a scan of the counts has put it.

namespace skein {

/// What the lists are made from, by value for kernels.
template <class Space>
struct ListSource {
  explicit ListSource(const DeviceOctree<Space>& tree)
      : boxes(tree.boxes),
        touching_first(tree.touching.first),
        touching(tree.touching.entries),
        direct_first(tree.x_direct.first),
        direct(tree.x_direct.entries) {}

  Kokkos::View<const Box*, Space> boxes;
  Kokkos::View<const int*, Space> touching_first, touching, direct_first, direct;
};

/// The arrays for entries whose counts are in lists.first(0) .. lists.first(n - 1).
template <class Entry, class Space>
void place_lists(const Space& space, DeviceLists<Entry, Space>& lists, const int n, const char* label) {
  lists.n_entries = scan_counts(space, lists.first, 0, n, 0);
  require_extent(lists.entries, static_cast<std::size_t>(lists.n_entries), label);
}

}  // namespace skein
