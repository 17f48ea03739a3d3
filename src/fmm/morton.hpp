#pragma once

#include <skein/arrays/types.hpp>

#include <cstdint>

namespace skein {

/// Sorts order by key, ascending and stable: equal keys keep their order. Only the low n_bits bits of the keys count.
/// The result is unique, so it depends on no number of threads.
/// @param spare_key, spare_order  at least as long as key and order
void sort_by_key(const Kokkos::View<std::uint64_t*, HostSpace>& key, const Kokkos::View<int*, HostSpace>& order, int n,
                 int n_bits, const Kokkos::View<std::uint64_t*, HostSpace>& spare_key,
                 const Kokkos::View<int*, HostSpace>& spare_order);

}  // namespace skein
