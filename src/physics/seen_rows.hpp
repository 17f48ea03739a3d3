#pragma once

#include "node_parts.hpp"

#include <string>
#include <utility>

namespace skein {

/// Room for numbers on the host, of which two are in use at once: kept, because new memory costs more than a copy.
inline double* find_room(const std::size_t which, const std::size_t n) {
  static HostScalars rooms[2];
  static const bool is_freed_in_time = [] {
    Kokkos::push_finalize_hook([] { rooms[0] = rooms[1] = {}; });
    return true;
  }();
  HostScalars& room = rooms[which];
  if (is_freed_in_time && room.extent(0) < n) {
    room = {};
    room = HostScalars(Kokkos::view_alloc(std::string("skein::find_room"), Kokkos::WithoutInitializing), n + n / 8);
  }
  return room.data();
}

/// Rows of an array as a communicator sees them.
class SeenRows {
 public:
  /// @param reaches_device_memory  what looks at the rows, where they are  @param room  where copies go: 0 or 1
  SeenRows(const Vectors& rows, const RowAccess access, const bool reaches_device_memory, const std::size_t room)
      : rows_(rows),
        are_copies_(access == RowAccess::by_copies ||
                    (access == RowAccess::as_needed && !on_host<ExecSpace> && !reaches_device_memory)) {
    ExecSpace().fence();
    if (are_copies_) copies_ = HostVectors(find_room(room, 3 * rows.extent(0)), rows.extent(0));
  }
  double* column(const std::size_t c) const {
    return are_copies_ ? copies_.data() + c * copies_.extent(0) : rows_.data() + c * rows_.stride(1);
  }
  double operator()(const std::size_t i, const std::size_t c) const { return column(c)[i]; }

  /// What is to be sent of the array is seen from here on.
  void look(const std::size_t first, const std::size_t n) const {
    if (are_copies_) copy(copies_, rows_, first, n);
  }
  /// The array gets what was received.
  void take(const std::size_t first, const std::size_t n) const {
    if (are_copies_) copy(rows_, copies_, first, n);
  }

 private:
  /// Column by column where there are gaps between them, which no copy between memories passes over.
  template <class To, class From>
  static void copy(const To& to, const From& from, const std::size_t first, const std::size_t n) {
    const ExecSpace space;
    const auto rows = std::make_pair(first, first + n);
    if (n == to.extent(0) && to.span_is_contiguous() && from.span_is_contiguous())
      Kokkos::deep_copy(space, to, from);
    else
      for (int c = 0; c < 3 && n > 0; ++c)
        Kokkos::deep_copy(space, Kokkos::subview(to, rows, c), Kokkos::subview(from, rows, c));
    space.fence();
  }

  Vectors rows_;
  HostVectors copies_;
  bool are_copies_;
};

}  // namespace skein
