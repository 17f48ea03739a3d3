#pragma once

#include <skein/core/math.hpp>
#include <skein/core/simd.hpp>

namespace skein {

namespace product {

/// C = A B for `row_packs` packs of rows and n_columns columns, all in registers. Every entry is one chain of fused
/// operations in the order of k, whatever block it falls into: a column's result does not depend on its neighbours.
template <int row_packs, int n_columns, class Real>
inline void multiply_block(const Real* a, const int a_stride, const int depth, const Real* b, const int b_stride,
                           Real* c, const int c_stride) {
  using simd::Pack;
  Pack<Real> sum[n_columns][row_packs] = {};
  for (int k = 0; k < depth; ++k) {
    Pack<Real> column[row_packs];
    SKEIN_UNROLL
    for (int i = 0; i < row_packs; ++i) column[i] = simd::load_pack(a + k * a_stride + i * simd::width<Real>);
    SKEIN_UNROLL
    for (int j = 0; j < n_columns; ++j) {
      const Real factor = b[k + j * b_stride];
      SKEIN_UNROLL
      for (int i = 0; i < row_packs; ++i) sum[j][i] += column[i] * factor;
    }
  }
  SKEIN_UNROLL
  for (int j = 0; j < n_columns; ++j) {
    SKEIN_UNROLL
    for (int i = 0; i < row_packs; ++i) simd::store_pack(c + j * c_stride + i * simd::width<Real>, sum[j][i]);
  }
}

template <int row_packs, class Real>
inline void multiply_rows(const Real* a, const int a_stride, const int depth, const Real* b, const int b_stride,
                          const int n_columns, Real* c, const int c_stride) {
  constexpr int at_once = row_packs == 1 ? 12 : row_packs == 2 ? 12 : row_packs == 3 ? 8 : 6;
  int j = 0;
  for (; j + at_once <= n_columns; j += at_once)
    multiply_block<row_packs, at_once>(a, a_stride, depth, b + j * b_stride, b_stride, c + j * c_stride, c_stride);
  for (; j + 4 <= n_columns; j += 4)
    multiply_block<row_packs, 4>(a, a_stride, depth, b + j * b_stride, b_stride, c + j * c_stride, c_stride);
  for (; j < n_columns; ++j)
    multiply_block<row_packs, 1>(a, a_stride, depth, b + j * b_stride, b_stride, c + j * c_stride, c_stride);
}

}  // namespace product

/// Real numbers rounded up to whole packs.
template <class Real>
constexpr int padded(const int n) {
  return math::ceil_div(n, simd::width<Real>) * simd::width<Real>;
}

/// C = A B on the host, columns contiguous: A [n_rows, depth], B [depth, n_columns], C [n_rows, n_columns].
/// n_rows is a multiple of simd::width; the matrices are small enough for the second cache.
template <class Real>
void multiply(const Real* a, const int n_rows, const int a_stride, const int depth, const Real* b, const int b_stride,
              const int n_columns, Real* c, const int c_stride) {
  constexpr int width = simd::width<Real>;
  int i = 0;
  for (; i + 4 * width <= n_rows; i += 4 * width)
    product::multiply_rows<4>(a + i, a_stride, depth, b, b_stride, n_columns, c + i, c_stride);
  const int left = (n_rows - i) / width;
  if (left == 3) product::multiply_rows<3>(a + i, a_stride, depth, b, b_stride, n_columns, c + i, c_stride);
  if (left == 2) product::multiply_rows<2>(a + i, a_stride, depth, b, b_stride, n_columns, c + i, c_stride);
  if (left == 1) product::multiply_rows<1>(a + i, a_stride, depth, b, b_stride, n_columns, c + i, c_stride);
}

}  // namespace skein
