#pragma once

#include <skein/arrays/runtime.hpp>
#include <skein/arrays/types.hpp>

namespace skein {

/// With how many host threads Kokkos begins, once it is sure that they can work: neither Kokkos nor the OpenMP library
/// would say in words what is wrong, and some of it would end the process later.
/// @param asked   0 leaves the choice to KOKKOS_NUM_THREADS, OMP_NUM_THREADS or the machine
/// @param useful  no more where the choice is the machine's
/// @throws Error(usage) for a number that Kokkos does not take, and for settings of the environment that leave threads
///         without room or forbid them; ResourceError if the system does not start that many
HostThreads choose_host_threads(int asked, int useful);

#if defined(KOKKOS_ENABLE_OPENMP)
inline constexpr bool have_host_threads = true;
#else
inline constexpr bool have_host_threads = false;
#endif

}  // namespace skein
