#pragma once

#include <skein/arrays/types.hpp>

#include <string>
#include <type_traits>

namespace skein {

/// How often a kernel is called, and about how long one call takes on one thread of a host.
struct Calls {
  int number = 0;
  double nanoseconds = 0.0;  ///< each

  /// Threads begin and end with a kernel, which takes 1 to 4 microseconds on two cores and more on many
  /// (docs/performance.md): what takes less than some of that by itself is left to the calling thread.
  bool are_worth_sharing() const { return number * nanoseconds > 10e3; }
};

/// Calls kernel(i) for i = 0 .. n - 1, as Kokkos::parallel_for does; on a host by the calling thread alone where that
/// is faster. Each number is written by one call, so that none depends on it.
/// @tparam Schedule  of threads
template <class Space, class Schedule = Kokkos::Schedule<Kokkos::Static>, class Kernel>
void launch(const std::string& label, const Space& space, const Calls calls, const Kernel& kernel) {
#if defined(KOKKOS_ENABLE_SERIAL)
  if constexpr (on_host<Space> && !std::is_same_v<Space, Kokkos::Serial>)
    if (!calls.are_worth_sharing())
      return Kokkos::parallel_for(label, Kokkos::RangePolicy<Kokkos::Serial>(Kokkos::Serial(), 0, calls.number),
                                  kernel);
#endif
  Kokkos::parallel_for(label, Kokkos::RangePolicy<Space, Schedule>(space, 0, calls.number), kernel);
}

/// The same with numbers that come back, as Kokkos::parallel_reduce does; only for such that do not depend on the order
/// of calls: minima, maxima, integers.
template <class Space, class Kernel, class... Reducers>
requires(requires { typename Reducers::reducer; } && ...)  // a number by itself would not come back
    void launch_reduction(const std::string& label, const Space& space, const Calls calls, const Kernel& kernel,
                          const Reducers&... reducers) {
#if defined(KOKKOS_ENABLE_SERIAL)
  if constexpr (on_host<Space> && !std::is_same_v<Space, Kokkos::Serial>)
    if (!calls.are_worth_sharing())
      return Kokkos::parallel_reduce(label, Kokkos::RangePolicy<Kokkos::Serial>(Kokkos::Serial(), 0, calls.number),
                                     kernel, reducers...);
#endif
  Kokkos::parallel_reduce(label, Kokkos::RangePolicy<Space>(space, 0, calls.number), kernel, reducers...);
}

/// Waits until all that was launched is done. Kokkos' tools hear of it on hosts, too, where nothing is waited for.
template <class Space>
void wait_for(const Space& space) {
  Kokkos::Profiling::markEvent("skein::wait");
  space.fence();
}

}  // namespace skein
