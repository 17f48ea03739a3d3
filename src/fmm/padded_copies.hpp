#pragma once

#include "fmm/fmm_operator_set.hpp"

#include <Eigen/Dense>

namespace skein {

/// A matrix as the passes want it. Views are made: not inside a parallel loop.
template <class Real>
PaddedMatrix<Real> to_padded(const Eigen::MatrixXd& matrix) {
  PaddedMatrix<Real> result;
  result.n_rows = padded<Real>(static_cast<int>(matrix.rows()));
  result.n_columns = static_cast<int>(matrix.cols());
  result.entry =
      Kokkos::View<Real*, HostSpace>("skein::padded_copies::entry", static_cast<std::size_t>(result.n_rows) *
                                                                        static_cast<std::size_t>(result.n_columns));
  for (int j = 0; j < result.n_columns; ++j)
    for (int i = 0; i < matrix.rows(); ++i)
      result.entry(static_cast<std::size_t>(j) * static_cast<std::size_t>(result.n_rows) +
                   static_cast<std::size_t>(i)) = static_cast<Real>(matrix(i, j));
  return result;
}

/// The same with planes of n rows, which begin at multiples of n_padded.
template <class Real>
PaddedMatrix<Real> to_padded_planes(const Eigen::MatrixXd& matrix, const int n, const int n_padded) {
  const auto n_planes = matrix.rows() / n;
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(n_planes * n_padded, matrix.cols());
  for (Eigen::Index c = 0; c < n_planes; ++c) spread.middleRows(c * n_padded, n) = matrix.middleRows(c * n, n);
  return to_padded<Real>(spread);
}

}  // namespace skein
