#pragma once

#include "fmm/fmm_operator_set.hpp"
#include "fmm/host_scratch.hpp"

#include <cstddef>

// Products of an operator with the coefficients of many boxes.

namespace skein {

/// column <- from with the signs of a reflection; the fourth column of the harmonic field (psi, measured from the box's
/// centre) is moved to the centre of the other box: to = scale * psi + shift . phi.
template <class Field, class Real>
void gather(const Real* from, const int stride, const int n, const Real* sign, const Real scale, const Real (&shift)[3],
            Real* to, const int to_stride) {
  if constexpr (Field::shifts) {
    for (int i = 0; i < n; ++i) {
      const Real x = from[i], y = from[i + stride], z = from[i + 2 * stride], psi = from[i + 3 * stride];
      to[i] = sign[i] * x;
      to[i + to_stride] = sign[i] * y;
      to[i + 2 * to_stride] = sign[i] * z;
      to[i + 3 * to_stride] = sign[i] * (scale * psi + shift[0] * x + shift[1] * y + shift[2] * z);
    }
  } else {
    for (int column = 0; column < Field::n_columns; ++column)
      for (int i = 0; i < n; ++i) to[i + column * to_stride] = sign[i] * from[i + column * stride];
  }
}

template <class Field, class Real>
void scatter(const Real* from, const int from_stride, const int n, const Real* sign, Real* to, const int stride) {
  for (int column = 0; column < Field::n_columns; ++column)
    for (int i = 0; i < n; ++i) to[i + column * stride] += sign[i] * from[i + column * from_stride];
}

inline constexpr int columns_at_once = 64;

/// One product for several pairs of boxes that share an operator, up to reflections.
template <class Real, class Field>
class PairBatch {
 public:
  PairBatch(const int depth, const int n_rows)
      : stride_(padded<Real>(depth)),
        out_stride_(n_rows),
        in_(stride_ * columns_at_once),
        middle_(stride_ * columns_at_once),
        out_(out_stride_ * columns_at_once) {}

  static constexpr int capacity = columns_at_once / Field::n_columns;
  bool is_full() const { return n_pairs_ == capacity; }

  void add(const Real* from, const int from_stride, const int depth, const Real* sign_in, const Real scale,
           const Real (&shift)[3], Real* to, const Real* sign_out) {
    gather<Field>(from, from_stride, depth, sign_in, scale, shift, in_.get() + n_pairs_ * Field::n_columns * stride_,
                  stride_);
    to_[n_pairs_] = to;
    sign_out_[n_pairs_++] = sign_out;
  }

  void apply(const PaddedMatrix<Real>& matrix, const int to_stride) {
    if (n_pairs_ == 0) return;
    matrix.apply(in_.get(), stride_, n_pairs_ * Field::n_columns, out_.get(), out_stride_);
    scatter_all(matrix.n_rows, to_stride);
  }
  void apply(const FactoredMatrix<Real>& matrix, const int to_stride) {
    if (n_pairs_ == 0) return;
    matrix.apply(in_.get(), stride_, n_pairs_ * Field::n_columns, middle_.get(), out_.get(), out_stride_);
    scatter_all(matrix.last.n_rows, to_stride);
  }

 private:
  void scatter_all(const int n_rows, const int to_stride) {
    for (int k = 0; k < n_pairs_; ++k)
      scatter<Field>(out_.get() + k * Field::n_columns * out_stride_, out_stride_, n_rows, sign_out_[k], to_[k],
                     to_stride);
    n_pairs_ = 0;
  }

  int stride_, out_stride_;
  HostScratch<Real> in_, middle_, out_;  ///< a factored matrix is never thicker in the middle
  Real* to_[capacity];
  const Real* sign_out_[capacity];
  int n_pairs_ = 0;
};

}  // namespace skein
