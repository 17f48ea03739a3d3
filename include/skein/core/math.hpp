#pragma once

// The only place that looks at the compiler's idea of host and device. Nothing of Kokkos is included, so that what
// parses, writes and prints can use vectors and still be compiled by the host's compiler alone.

#include <cmath>

#if defined(__CUDA_ARCH__) || defined(__HIP_DEVICE_COMPILE__)
#define SKEIN_ON_DEVICE 1
#else
#define SKEIN_ON_DEVICE 0
#endif

/// A function for the host and, where the compiler builds for one, for a device.
#if defined(__CUDACC__) || defined(__HIPCC__)
#define SKEIN_INLINE_FUNCTION inline __host__ __device__
#else
#define SKEIN_INLINE_FUNCTION inline
#endif

/// A formula that device kernels and CPU vector types share. constexpr rather than __host__ __device__: nvcc then
/// compiles it for the device only where device code calls it, and so never for CPU vectors, which it refuses there.
#define SKEIN_FORMULA [[gnu::always_inline]] constexpr inline

namespace skein::math {

/// sqrt of the argument's own precision: an unqualified sqrt(float) may be the double one.
SKEIN_INLINE_FUNCTION double sqrt(const double x) {
#if SKEIN_ON_DEVICE
  return ::sqrt(x);
#else
  return std::sqrt(x);
#endif
}
SKEIN_INLINE_FUNCTION float sqrt(const float x) {
#if SKEIN_ON_DEVICE
  return ::sqrtf(x);
#else
  return std::sqrt(x);
#endif
}

SKEIN_INLINE_FUNCTION double sin(const double x) {
#if SKEIN_ON_DEVICE
  return ::sin(x);
#else
  return std::sin(x);
#endif
}
SKEIN_INLINE_FUNCTION double cos(const double x) {
#if SKEIN_ON_DEVICE
  return ::cos(x);
#else
  return std::cos(x);
#endif
}

/// 1/sqrt(x); one instruction sequence on GPUs.
template <class Real>
SKEIN_INLINE_FUNCTION Real inverse_sqrt(const Real x) {
#if SKEIN_ON_DEVICE
  return ::rsqrt(x);
#else
  return Real(1) / sqrt(x);
#endif
}

SKEIN_INLINE_FUNCTION constexpr int smaller(const int a, const int b) { return a < b ? a : b; }
SKEIN_INLINE_FUNCTION constexpr int larger(const int a, const int b) { return a > b ? a : b; }
void smaller(double, double) = delete;  // would be cut to integers
void larger(double, double) = delete;
SKEIN_INLINE_FUNCTION constexpr int ceil_div(const int a, const int b) { return (a + b - 1) / b; }

}  // namespace skein::math
