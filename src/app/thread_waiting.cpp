#include "app/thread_waiting.hpp"

#include <skein/core/portable.hpp>

#include <cstdlib>

#if defined(__linux__)
#include <unistd.h>
#endif

namespace skein {

void limit_thread_spinning([[maybe_unused]] char** argv) {
#if defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && defined(KOKKOS_ENABLE_OPENMP)
  if (std::getenv("GOMP_SPINCOUNT") != nullptr || std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  if (setenv("GOMP_SPINCOUNT", "10000", 0) != 0) return;
  execv("/proc/self/exe", argv);  // returns only where it is not possible; then the run is merely slower
#endif
}

}  // namespace skein
