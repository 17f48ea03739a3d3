#pragma once

// The only place that looks at the version of Kokkos (3.4 to 5.x).

#include <Kokkos_Core.hpp>

#if !defined(KOKKOS_VERSION) || KOKKOS_VERSION < 30400
#error "skein needs Kokkos 3.4 or newer: run tools/setup.sh"
#endif

namespace skein {

/// Memory of the host that kernels write, too: a number that they leave there is read without a copy, after a wait.
#if KOKKOS_VERSION >= 40000
using SharedHostMemory = Kokkos::SharedHostPinnedSpace;
#elif defined(KOKKOS_ENABLE_CUDA)
using SharedHostMemory = Kokkos::CudaHostPinnedSpace;
#elif defined(KOKKOS_ENABLE_HIP)
using SharedHostMemory = Kokkos::Experimental::HIPHostPinnedSpace;
#else
using SharedHostMemory = Kokkos::HostSpace;
#endif

/// Kokkos::initialize with a number of host threads; 0 leaves the choice to the environment.
inline void initialize_kokkos(const int threads) {
#if KOKKOS_VERSION >= 30700
  Kokkos::InitializationSettings settings;
  if (threads > 0) settings.set_num_threads(threads);
  settings.set_disable_warnings(true);
  Kokkos::initialize(settings);
#else
  Kokkos::InitArguments arguments;
  if (threads > 0) arguments.num_threads = threads;
  arguments.disable_warnings = true;
  Kokkos::initialize(arguments);
#endif
}

}  // namespace skein
