#include "tests/support/nan_trap.hpp"

#include <skein/arrays/types.hpp>

#include <cfenv>
#include <cstdlib>

namespace skein::test {

bool traps_nan() {
#ifdef __GLIBC__
  return std::getenv("SKEIN_TRAP_NAN") != nullptr;
#else
  return false;
#endif
}

void set_nan_trap([[maybe_unused]] const bool on) {
#ifdef __GLIBC__
  const auto set = [on](int /*thread*/) {
    constexpr int trapped = FE_INVALID | FE_DIVBYZERO;
    std::feclearexcept(trapped);
    if (on)
      feenableexcept(trapped);
    else
      fedisableexcept(trapped);
  };
  // One iteration to each thread; the tests' own is the first of them.
  const int n_threads = HostSpace().concurrency();
  Kokkos::parallel_for("skein::test::set_nan_trap",
                       Kokkos::RangePolicy<HostSpace, Kokkos::Schedule<Kokkos::Static>>(0, n_threads), set);
#endif
}

}  // namespace skein::test
