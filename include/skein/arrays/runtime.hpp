#pragma once

#include <string>

namespace skein {

/// Kokkos has places for so many.
inline constexpr int most_host_threads = 512;

/// Kokkos for the lifetime of the object. Created first in main and in the tests' main; nothing that holds device
/// memory may outlive it.
class Runtime {
 public:
  /// @param threads  host threads; 0 leaves the choice to KOKKOS_NUM_THREADS, OMP_NUM_THREADS or the machine
  /// @param useful   no more than these where the choice is the machine's
  /// @throws Error(usage) if the number, or a setting of the environment, cannot work; ResourceError if the
  /// system
  ///         does not start so many threads
  explicit Runtime(int threads = 0, int useful = most_host_threads);
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;
};

/// How a Runtime came to its number of host threads.
struct HostThreads {
  int number = 1;
  int useful = most_host_threads;  ///< as the Runtime was told
  int possible = 1;                ///< without regard to what is useful
  std::string asked_by;            ///< "--threads" or a variable of the environment; empty: nobody
};

/// Of the last Runtime.
const HostThreads& host_threads();

/// How many host threads a Runtime would take; starts none. @throws Error(usage) as Runtime does; 1 where there are
/// none
int count_host_threads(int asked = 0);

/// One line: backend, device and threads, as a run's first lines print it.
std::string describe_backend();

/// Several lines of "key: value": version, commit, compiler, Kokkos version and backends.
std::string describe_build();

}  // namespace skein
