#pragma once

#include "fmm/level_operators.hpp"

// Matrix products by the threads of a device: a thread has some rows of all columns, so that what it reads of the
// matrix serves several columns and what it reads of these several rows. Every number is a sum over k in order.

namespace skein {

/// Columns of B one after the other.
template <class Real>
struct StridedColumns {
  const Real* entry;
  int stride;
  template <int n_columns>
  KOKKOS_INLINE_FUNCTION void read(const int k, Real (&b)[n_columns]) const {
    for (int j = 0; j < n_columns; ++j) b[j] = entry[k + j * stride];
  }
};

/// As many columns as a thread multiplies at once, side by side; read as packs of four.
template <class Number, int n_columns>
struct alignas(n_columns * sizeof(Number) % 16 == 0 ? 16 : sizeof(Number)) ColumnGroup {
  using Real = Number;
  static constexpr int size = n_columns;
  Real value[size];
};
template <class Group>
struct GroupedColumns {
  const Group* group;
  KOKKOS_INLINE_FUNCTION void read(const int k, typename Group::Real (&b)[Group::size]) const {
    const Group columns = group[k];
    for (int j = 0; j < Group::size; ++j) b[j] = columns.value[j];
  }
};

/// Rows row, row + step, ... of A B; those past the end are computed again and not written.
template <int n_rows, int n_columns, class Real, class Columns, class Write>
KOKKOS_INLINE_FUNCTION void multiply_strided(const Matrix<Real>& a, const int row, const int step, const Columns& b,
                                             const Write& write) {
  constexpr int at_once = 4;  // entries on their way from memory
  Real sum[n_rows][n_columns] = {};
  int place[n_rows];
  for (int i = 0; i < n_rows; ++i) place[i] = math::smaller(row + i * step, a.n_rows - 1);
  const Real* column = a.entry;
  int k = 0;
  for (; k + at_once <= a.n_columns; k += at_once, column += at_once * a.n_rows) {
    Real entry[at_once][n_rows];
    for (int u = 0; u < at_once; ++u)
      for (int i = 0; i < n_rows; ++i) entry[u][i] = column[u * a.n_rows + place[i]];
    for (int u = 0; u < at_once; ++u) {
      Real factor[n_columns];
      b.read(k + u, factor);
      for (int i = 0; i < n_rows; ++i)
        for (int j = 0; j < n_columns; ++j) sum[i][j] += entry[u][i] * factor[j];
    }
  }
  for (; k < a.n_columns; ++k, column += a.n_rows) {
    Real factor[n_columns];
    b.read(k, factor);
    for (int i = 0; i < n_rows; ++i)
      for (int j = 0; j < n_columns; ++j) sum[i][j] += column[place[i]] * factor[j];
  }
  for (int i = 0; i < n_rows; ++i)
    if (row + i * step < a.n_rows) write(row + i * step, sum[i]);
}

/// Rows lane, lane + n_threads, ... of A B, up to four at once.
template <int n_columns, int most_rows, class Real, class Columns, class Write>
KOKKOS_INLINE_FUNCTION void multiply_by_thread(const Matrix<Real>& a, const int lane, const int n_threads,
                                               const Columns& b, const Write& write) {
  for (int first = 0; first < a.n_rows;) {
    const int left = math::ceil_div(a.n_rows - first, n_threads);
    if constexpr (most_rows > 2) {
      if (left > 2) {
        multiply_strided<4, n_columns>(a, first + lane, n_threads, b, write);
        first += 4 * n_threads;
        continue;
      }
    }
    if constexpr (most_rows > 1) {
      if (left > 1) {
        multiply_strided<2, n_columns>(a, first + lane, n_threads, b, write);
        first += 2 * n_threads;
        continue;
      }
    }
    multiply_strided<1, n_columns>(a, first + lane, n_threads, b, write);
    first += n_threads;
  }
}

}  // namespace skein
