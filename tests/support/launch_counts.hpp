#pragma once

#include <skein/arrays/types.hpp>

#include <cstdint>
#include <string_view>

// What Kokkos tells its tools. On hosts that is not all: copies from a host to itself are not made.

namespace skein::test {

/// Kernels, reductions, copies and fills, and waits: Kokkos' own, and those of wait_for.
struct Launches {
  int kernels = 0, reductions = 0, copies = 0, fences = 0, waits = 0;
  friend bool operator==(const Launches&, const Launches&) = default;
};

/// Counts from its beginning to its end.
class Counting {
 public:
  Counting() {
    counted() = {};
    set(true);
  }
  ~Counting() { set(false); }
  Counting(const Counting&) = delete;
  Counting& operator=(const Counting&) = delete;

  const Launches& so_far() const { return counted(); }

 private:
  static Launches& counted() {
    static Launches launches;
    return launches;
  }
  using Space = Kokkos::Tools::SpaceHandle;
  static void count_kernel(const char*, std::uint32_t, std::uint64_t*) { ++counted().kernels; }
  static void count_reduction(const char*, std::uint32_t, std::uint64_t*) { ++counted().reductions; }
  static void count_copy(Space, const char*, const void*, Space, const char*, const void*, std::uint64_t) {
    ++counted().copies;
  }
  /// But those that Kokkos makes for its tools' sake.
  static void count_fence(const char* name, std::uint32_t, std::uint64_t*) {
    counted().fences += std::string_view(name).find("Profile Tool") == std::string_view::npos;
  }
  static void count_event(const char* name) { counted().waits += std::string_view(name) == "skein::wait"; }

  static void set(const bool on) {
    namespace tools = Kokkos::Tools::Experimental;
    tools::set_begin_parallel_for_callback(on ? count_kernel : nullptr);
    tools::set_begin_parallel_scan_callback(on ? count_kernel : nullptr);
    tools::set_begin_parallel_reduce_callback(on ? count_reduction : nullptr);
    tools::set_begin_deep_copy_callback(on ? count_copy : nullptr);
    tools::set_begin_fence_callback(on ? count_fence : nullptr);
    tools::set_profile_event_callback(on ? count_event : nullptr);
  }
};

}  // namespace skein::test
