#pragma once

#include "fmm/lists.hpp"

#include <cstdint>

namespace skein {

/// Keys and what is sorted by them.
template <class Space>
struct KeyedOrder {
  Kokkos::View<std::uint64_t*, Space> key;
  Kokkos::View<int*, Space> order;

  void require(const std::size_t n) {
    require_extent(key, n, "skein::key_sort::key");
    require_extent(order, n, "skein::key_sort::order");
  }
  double bytes() const { return 8.0 * static_cast<double>(key.extent(0)) + 4.0 * static_cast<double>(order.extent(0)); }
};

/// What the sort needs besides; kept between calls.
template <class Space>
struct SortSpace {
  KeyedOrder<Space> spare;
  Kokkos::View<int*, Space> place;
};

/// So many keys are sooner compared with each other, in one launch, than sorted digit by digit; on hosts never.
template <class Space>
inline constexpr int few_keys = on_host<Space> ? 0 : 12288;

/// The first n of `sorted` by key, ascending and stable: equal keys keep their order. Only the low n_bits bits of the
/// keys count. The result is unique, so it depends on no number of threads. Arrays may change places with the spare
/// ones.
/// @param few  up to so many keys are compared with each other; the result does not depend on it. More are asked first
///             whether they are sorted already, which is a wait for the device
template <class Space>
void sort_by_key(const Space& space, KeyedOrder<Space>& sorted, int n, int n_bits, SortSpace<Space>& memory,
                 int few = few_keys<Space>);

}  // namespace skein
