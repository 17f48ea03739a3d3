#pragma once

#include <skein/arrays/launch.hpp>

#include <cstddef>
#include <span>
#include <string>

// Arrays of the fast multipole method in the memory of any execution space: kept between evaluations, filled by
// counting, scanning and filling.

namespace skein {

template <class View>
void require_extent(View& view, const std::size_t n, const char* label) {
  if (view.extent(0) >= n) return;
  view = View();  // before the new one is allocated
  view = View(Kokkos::view_alloc(std::string(label), Kokkos::WithoutInitializing), n + n / 8);
}

/// The same for an array whose entries are still needed.
template <class View>
void extend(View& view, const std::size_t n) {
  if (view.extent(0) < n) Kokkos::resize(view, n + n / 2);
}

template <class Space>
struct CopyNumbers {
  Kokkos::View<const int*, Space> from;
  FoundNumbers to;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const { to(i) = from(i); }
};

/// The first n numbers of an array. Does not wait for the device.
template <class Space>
void leave_for_host(const Space& space, const Kokkos::View<const int*, Space>& from, const int n,
                    const FoundNumbers& to) {
  launch<Space>("skein::leave_for_host", space, Calls{n, 1.0}, CopyNumbers<Space>{from, to});
}

/// Waits for the device.
template <class Space>
int read_number(const Kokkos::View<int*, Space>& from, const int i) {
  if constexpr (on_host<Space>) return from(i);
  int number = 0;
  Kokkos::deep_copy(number, Kokkos::subview(from, i));
  return number;
}

/// Calls scan(i, sum, is_final) for begin <= i <= end as Kokkos::parallel_scan does. Waits for nothing.
template <class Space, class Scan>
void scan_each(const Space& space, const int begin, const int end, const Scan& scan) {
  int sum = 0;
  if (on_host<Space> && !Calls{end - begin, 2.0}.are_worth_sharing())
    for (int i = begin; i <= end; ++i) scan(i, sum, true);
  else
    Kokkos::parallel_scan("skein::scan_counts", Kokkos::RangePolicy<Space>(space, begin, end + 1), scan);
}

/// What scan_counts does at one entry. No lambda: in a template of a header the device's compiler may not find it
/// again.
template <class Space>
struct ScanCount {
  Kokkos::View<int*, Space> count;
  int end;

  KOKKOS_INLINE_FUNCTION void operator()(const int i, int& sum, const bool is_final) const {
    const int here = i < end ? count(i) : 0;
    if (is_final) count(i) = sum;
    sum += here;
  }
};

/// count(i) <- the counts of 0 .. i - 1, for 0 <= i <= end: entry `end` exists and is overwritten. Waits for nothing.
template <class Space>
void scan_in_place(const Space& space, const Kokkos::View<int*, Space>& count, const int end) {
  scan_each<Space>(space, 0, end, ScanCount<Space>{count, end});
}

/// The same, and waits for the sum of all counts. @return it
template <class Space>
int scan_counts(const Space& space, const Kokkos::View<int*, Space>& count, const int end) {
  scan_in_place(space, count, end);
  return read_number(count, end);
}

/// Entries of several lists, one after the other: list i is entries(first(i)) .. entries(first(i + 1) - 1).
template <class Entry, class Space>
struct Lists {
  Kokkos::View<int*, Space> first;
  Kokkos::View<Entry*, Space> entries;
  int n_entries = 0;

  /// For the entries of n lists.
  KOKKOS_INLINE_FUNCTION bool has_room(const int n) const { return first(n) <= entries.extent_int(0); }
  /// List i, where the host reaches the memory.
  std::span<const Entry> of(const int i) const { return {entries.data() + first(i), entries.data() + first(i + 1)}; }
  double bytes() const {
    return static_cast<double>(entries.extent(0) * sizeof(Entry) + first.extent(0) * sizeof(int));
  }
};

/// Where entries of one list go, or only their number: the same code counts and fills.
template <class Entry>
struct EntrySink {
  Entry* to = nullptr;
  int n = 0;

  KOKKOS_INLINE_FUNCTION void add(const Entry& entry) {
    if (to != nullptr) to[n] = entry;
    ++n;
  }
};

}  // namespace skein
