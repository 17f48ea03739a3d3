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
  /// @throws Error(usage) if the number, or a setting of the environment, cannot work; ResourceError if the
  /// system
  ///         does not start so many threads
  explicit Runtime(int threads = 0);
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;
};

/// How many host threads a Runtime would take; starts none. @throws Error(usage) as Runtime does; 1 where there are
/// none
int count_host_threads(int asked = 0);

/// One line: backend, device and threads, as a run's first lines print it.
std::string describe_backend();

/// Several lines of "key: value": version, commit, compiler, Kokkos version and backends.
std::string describe_build();

}  // namespace skein
