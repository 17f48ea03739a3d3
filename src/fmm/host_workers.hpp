#pragma once

#include "fmm/box_sums.hpp"
#include "fmm/host_scratch.hpp"
#include "fmm/matrix_product.hpp"

#include <string>

// How threads of a host work through the boxes of a tree: each alone, some boxes at a time, with surface points and the
// rows of matrices in packs.

namespace skein {

using simd::Pack;

/// C = A B by packs of rows; @param b [n_columns, n], stride b_stride; @param c [n_rows, n], stride c_stride
template <class Real>
void multiply(const Matrix<Real>& a, const Real* b, const int b_stride, const int n, Real* c, const int c_stride) {
  multiply(a.entry, a.n_rows, a.n_rows, a.n_columns, b, b_stride, n, c, c_stride);
}

inline constexpr int columns_at_once = 64;

/// One product for several pairs of boxes that share an operator, up to reflections.
template <class Real, class Field>
class HostBatch {
 public:
  HostBatch(const int n_in, const int n_out)
      : in_stride_(padded<Real>(n_in)),
        out_stride_(n_out),
        in_(in_stride_ * columns_at_once),
        middle_(in_stride_ * columns_at_once),
        out_(out_stride_ * columns_at_once) {}

  bool is_full() const { return n_pairs_ == capacity; }

  /// @param n_in  a number of whole packs, as all rows of coefficients are
  void add(const Real* from, const int from_stride, const int n_in, const Real* sign_in, const Real scale,
           const Real (&shift)[3], Real* to, const Real* sign_out) {
    Real* const column = in_.data() + n_pairs_ * Field::n_columns * in_stride_;
    for (int i = 0; i < n_in; i += simd::width<Real>) {
      Pack<Real> rows[Field::n_columns];
      for (int c = 0; c < Field::n_columns; ++c) rows[c] = simd::load_pack(from + c * from_stride + i);
      move_row<Field>(simd::load_pack(sign_in + i), scale, shift, rows);
      for (int c = 0; c < Field::n_columns; ++c) simd::store_pack(column + c * in_stride_ + i, rows[c]);
    }
    to_[n_pairs_] = to;
    sign_out_[n_pairs_++] = sign_out;
  }

  void apply(const Matrix<Real>& matrix, const int to_stride) { apply(matrix, Matrix<Real>{}, to_stride); }
  /// @param first  a thin factor before `last`; without columns where `last` is the whole
  void apply(const Matrix<Real>& last, const Matrix<Real>& first, const int to_stride) {
    if (n_pairs_ == 0) return;
    const int n = n_pairs_ * Field::n_columns;
    if (first.n_columns > 0) {  // never thicker in the middle
      multiply(first, in_.data(), in_stride_, n, middle_.data(), first.n_rows);
      multiply(last, middle_.data(), first.n_rows, n, out_.data(), out_stride_);
    } else {
      multiply(last, in_.data(), in_stride_, n, out_.data(), out_stride_);
    }
    for (int k = 0; k < n_pairs_; ++k)
      for (int column = 0; column < Field::n_columns; ++column) {
        const Real* from = out_.data() + (k * Field::n_columns + column) * out_stride_;
        Real* const to = to_[k] + column * to_stride;
        for (int i = 0; i < last.n_rows; ++i) to[i] += sign_out_[k][i] * from[i];
      }
    n_pairs_ = 0;
  }

 private:
  static constexpr int capacity = columns_at_once / Field::n_columns;
  int in_stride_, out_stride_;
  HostScratch<Real> in_, middle_, out_;
  Real* to_[capacity];
  const Real* sign_out_[capacity];
  int n_pairs_ = 0;
};

/// A thread that works alone.
struct HostWorker {
  static constexpr int rank() { return 0; }
  static constexpr int size() { return 1; }
  static constexpr void barrier() {}

  template <class Entry>
  HostScratch<Entry> array(const int n) const {
    return HostScratch<Entry>(n);
  }
  template <class Real, class Field, int most_pairs>
  HostBatch<Real, Field> batch(const int n_in, const int n_out) const {
    return HostBatch<Real, Field>(n_in, n_out);
  }

  template <int n_columns, class Real, class Write>
  void multiply(const Matrix<Real>& a, const Real* b, const int b_stride, const Write& write) const {
    const HostScratch<Real> product(n_columns * a.n_rows);
    skein::multiply(a, b, b_stride, n_columns, product.data(), a.n_rows);
    for (int row = 0; row < a.n_rows; ++row) {
      Real sum[n_columns];
      for (int column = 0; column < n_columns; ++column) sum[column] = product.data()[row + column * a.n_rows];
      write(row, sum);
    }
  }

  /// potential[plane][n_padded] += field of a run of sources at the surface of that size about a box's centre.
  /// @param tile  [source_tile]
  template <class Real, class Field>
  void add_potentials(const SortedNodes<HostSpace>& nodes, const IndexRange run, const Vec3 center,
                      const double half_width, const Field& field, const LevelOperators<Real>& operators,
                      const Real size, FarSource<Real>* tile, Real* potential) const {
    constexpr int width = simd::width<Real>;
    for (int first = 0; first < run.count; first += source_tile) {
      const int count = math::smaller(source_tile, run.count - first);
      for (int s = 0; s < count; ++s)
        tile[s] = load_far_source<HostSpace, Real>(nodes, run.first + first + s, center, 1.0 / half_width);
      int i = 0;
      for (; i + 2 * width <= operators.n_padded; i += 2 * width)
        add_to_points<2>(field, operators, size, i, tile, count, potential);
      for (; i < operators.n_padded; i += width) add_to_points<1>(field, operators, size, i, tile, count, potential);
    }
  }

 private:
  template <int packs, class Real, class Field>
  static void add_to_points(const Field& field, const LevelOperators<Real>& operators, const Real size, const int first,
                            const FarSource<Real>* sources, const int n_sources, Real* potential) {
    constexpr int width = simd::width<Real>;
    Pack<Real> x[packs][3], sum[packs][Field::n_planes] = {};
    for (int k = 0; k < packs; ++k)
      for (int c = 0; c < 3; ++c)
        x[k][c] = size * simd::load_pack(operators.surface + c * operators.n_padded + first + k * width);
    add_sources(field, sources, n_sources, x, sum);
    for (int k = 0; k < packs; ++k)
      for (int plane = 0; plane < Field::n_planes; ++plane) {
        Real* const at = potential + plane * operators.n_padded + first + k * width;
        simd::store_pack(at, simd::load_pack(at) + sum[k][plane]);
      }
  }
};

/// A loop over some tasks that threads take in turn; few are not worth a fork.
template <class Use>
void for_tasks(const std::string& label, const int n_tasks, const Use& use) {
  if (n_tasks == 1) return use(0);
  Kokkos::parallel_for(label,
                       Kokkos::RangePolicy<HostSpace, Kokkos::Schedule<Kokkos::Dynamic>>(HostSpace(), 0, n_tasks), use);
}

/// work(worker, boxes) for parts of the boxes, in parallel. How they are divided changes no result.
template <class Work>
void for_boxes_on_host(const std::string& label, const IndexRange boxes, const Work& work) {
  constexpr int most = 64;
  if (boxes.count == 0) return;
  const int wanted = math::ceil_div(boxes.count, 8 * HostSpace().concurrency());
  const int size = math::larger(1, math::smaller(most, wanted)), n_tasks = math::ceil_div(boxes.count, size);
  for_tasks(label, n_tasks, [&](const int task) {
    const int first = task * size;
    work(HostWorker{}, IndexRange{boxes.first + first, math::smaller(size, boxes.count - first)});
  });
}

}  // namespace skein
