#pragma once

// The only place that looks at the Kokkos version (3.4 to 5.x) or at the compiler's idea of host and device.

#include <Kokkos_Core.hpp>

#include <cmath>

#if !defined(KOKKOS_VERSION) || KOKKOS_VERSION < 30400
#error "skein needs Kokkos 3.4 or newer: run tools/setup.sh"
#endif

#if defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)
#define SKEIN_ON_DEVICE 1
#else
#define SKEIN_ON_DEVICE 0
#endif

/// A formula that device kernels and CPU vector types share. constexpr rather than __host__ __device__: nvcc then
/// compiles it for the device only where device code calls it, and so never for CPU vectors, which it refuses there.
#define SKEIN_FORMULA [[gnu::always_inline]] constexpr inline

namespace skein::math {

/// sqrt of the argument's own precision: an unqualified sqrt(float) may be the double one.
KOKKOS_INLINE_FUNCTION double sqrt(const double x) {
#if SKEIN_ON_DEVICE
  return ::sqrt(x);
#else
  return std::sqrt(x);
#endif
}
KOKKOS_INLINE_FUNCTION float sqrt(const float x) {
#if SKEIN_ON_DEVICE
  return ::sqrtf(x);
#else
  return std::sqrt(x);
#endif
}

KOKKOS_INLINE_FUNCTION double sin(const double x) {
#if SKEIN_ON_DEVICE
  return ::sin(x);
#else
  return std::sin(x);
#endif
}
KOKKOS_INLINE_FUNCTION double cos(const double x) {
#if SKEIN_ON_DEVICE
  return ::cos(x);
#else
  return std::cos(x);
#endif
}

/// 1/sqrt(x); one instruction sequence on GPUs.
template <class Real>
KOKKOS_INLINE_FUNCTION Real inverse_sqrt(const Real x) {
#if SKEIN_ON_DEVICE
  return ::rsqrt(x);
#else
  return Real(1) / sqrt(x);
#endif
}

KOKKOS_INLINE_FUNCTION constexpr int smaller(const int a, const int b) { return a < b ? a : b; }
KOKKOS_INLINE_FUNCTION constexpr int larger(const int a, const int b) { return a > b ? a : b; }
void smaller(double, double) = delete;  // would be cut to integers
void larger(double, double) = delete;
KOKKOS_INLINE_FUNCTION constexpr int ceil_div(const int a, const int b) { return (a + b - 1) / b; }

}  // namespace skein::math

namespace skein {

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
