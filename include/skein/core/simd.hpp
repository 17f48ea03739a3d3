#pragma once

// Vectors of CPU lanes for the host kernels, by the vector extension that g++, clang and nvcc's host pass share: a loop
// over lanes that the compiler must recognise is vectorized in one place and not in the next, a vector type always is.

#include <cstdint>
#include <cstring>

#if defined(__SSE__) || defined(__AVX__)
#include <immintrin.h>
#endif

/// Before a loop over a few packs: keeps them in registers. nvcc's front end does not know the pragma.
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
#define SKEIN_UNROLL _Pragma("GCC unroll 8")
#else
#define SKEIN_UNROLL
#endif

namespace skein::simd {

#if defined(__AVX512F__) && defined(__AVX512DQ__)
inline constexpr int bytes = 64;
#elif defined(__AVX__)
inline constexpr int bytes = 32;
#else
inline constexpr int bytes = 16;
#endif

template <class Real>
struct PackOf;
template <>
struct PackOf<double> {
  typedef double type __attribute__((vector_size(bytes)));
  typedef std::int64_t bits __attribute__((vector_size(bytes)));
};
template <>
struct PackOf<float> {
  typedef float type __attribute__((vector_size(bytes)));
  typedef std::int32_t bits __attribute__((vector_size(bytes)));
};

/// As many Reals as the widest registers hold.
template <class Real>
using Pack = typename PackOf<Real>::type;
template <class Real>
inline constexpr int width = bytes / static_cast<int>(sizeof(Real));

template <class Real>
inline Pack<Real> load_pack(const Real* from) {
  Pack<Real> pack;
  std::memcpy(&pack, from, bytes);
  return pack;
}
template <class Real>
inline void store_pack(Real* to, const Pack<Real> pack) {
  std::memcpy(to, &pack, bytes);
}

/// Half as many floats as a pack of them holds: one for each lane of a pack of doubles.
typedef float HalfPack __attribute__((vector_size(bytes / 2)));

inline Pack<double> to_double(const HalfPack half) { return __builtin_convertvector(half, Pack<double>); }
inline HalfPack to_single(const Pack<double> pack) { return __builtin_convertvector(pack, HalfPack); }
inline HalfPack half_of(const Pack<float>& pack, const int which) {
  HalfPack half;
  std::memcpy(&half, reinterpret_cast<const char*>(&pack) + which * (bytes / 2), bytes / 2);
  return half;
}

/// Sum of the lanes in double, in a fixed order: by halves, so that few operations wait for each other.
inline double sum_lanes(const Pack<double> pack) {
  double lanes[width<double>];
  std::memcpy(lanes, &pack, bytes);
  for (int half = width<double> / 2; half > 0; half /= 2)
    for (int i = 0; i < half; ++i) lanes[i] += lanes[i + half];
  return lanes[0];
}
inline double sum_lanes(const Pack<float> pack) {
  return sum_lanes(to_double(half_of(pack, 0)) + to_double(half_of(pack, 1)));
}

/// to[lane] += pack[lane], in double.
inline void add_lanes(double* to, const Pack<double> pack) { store_pack(to, load_pack(to) + pack); }
inline void add_lanes(double* to, const Pack<float> pack) {
  for (int half = 0; half < 2; ++half) add_lanes(to + half * width<double>, to_double(half_of(pack, half)));
}

inline Pack<double> smaller_lanes(const Pack<double> a, const Pack<double> b) { return a < b ? a : b; }
inline Pack<double> larger_lanes(const Pack<double> a, const Pack<double> b) { return a > b ? a : b; }
inline double smallest_lane(const Pack<double> pack) {
  double smallest = pack[0];
  for (int lane = 1; lane < width<double>; ++lane) smallest = pack[lane] < smallest ? pack[lane] : smallest;
  return smallest;
}
inline double largest_lane(const Pack<double> pack) { return -smallest_lane(-pack); }

/// y with |1 - x y^2| < 8e-4 in single and < 1.3e-4 in double precision; x > 0.
/// The processor's estimate where it has one for this precision, else Blinn's linear guess by the bits of the number
/// (IEEE Computer Graphics and Applications 17(4), 1997) and one Householder step of order 5 or 4.
inline Pack<double> estimate_inverse_sqrt(const Pack<double> x) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  return (Pack<double>)_mm512_maskz_rsqrt14_pd(__mmask8(-1), (__m512d)x);  // maskz: g++ 12 warns of the plain one
#else
  const Pack<double> y = (Pack<double>)(0x5fe6eb50c7b537a9LL - ((PackOf<double>::bits)x >> 1));
  const Pack<double> e = 1.0 - x * y * y;
  return y + y * e * (0.5 + e * (0.375 + e * (0.3125 + e * 0.2734375)));
#endif
}
inline Pack<float> estimate_inverse_sqrt(const Pack<float> x) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  return (Pack<float>)_mm512_maskz_rsqrt14_ps(__mmask16(-1), (__m512)x);
#elif defined(__AVX__)
  return (Pack<float>)_mm256_rsqrt_ps((__m256)x);
#elif defined(__SSE__)
  return (Pack<float>)_mm_rsqrt_ps((__m128)x);
#else
  const Pack<float> y = (Pack<float>)(0x5f375a86 - ((PackOf<float>::bits)x >> 1));
  const Pack<float> e = 1.0f - x * y * y;
  return y + y * e * (0.5f + e * (0.375f + e * 0.3125f));
#endif
}

/// x^(-3/2) to within 4 units of the last place, x > 0: the series of (1 - e)^(-3/2) about the estimate y, where
/// e = 1 - x y^2.
inline Pack<double> inverse_sqrt_cubed(const Pack<double> x) {
  const Pack<double> y = estimate_inverse_sqrt(x);
  const Pack<double> y2 = y * y;
  const Pack<double> e = 1.0 - x * y2;
  const Pack<double> y3 = y2 * y;
  return y3 + y3 * e * (1.5 + e * (1.875 + e * 2.1875));
}
inline Pack<float> inverse_sqrt_cubed(const Pack<float> x) {
  const Pack<float> y = estimate_inverse_sqrt(x);
  const Pack<float> y2 = y * y;
  const Pack<float> e = 1.0f - x * y2;
  const Pack<float> y3 = y2 * y;
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  return y3 * (1.0f + 1.5f * e);  // |e| < 1.3e-4: the next term is below 4e-8
#else
  return y3 + y3 * e * (1.5f + e * 1.875f);
#endif
}

}  // namespace skein::simd
