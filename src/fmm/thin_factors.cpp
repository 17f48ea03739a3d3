#include "thin_factors.hpp"

#include <skein/core/error.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace skein {
namespace {

using Eigen::MatrixXd;

/// The columns of A that stick out most, orthonormal, a few at once, until less than `allowed` (squared Frobenius norm)
/// is left of A.
MatrixXd find_range(MatrixXd matrix, const double allowed) {
  constexpr Eigen::Index at_once = 16;
  MatrixXd range(matrix.rows(), std::min(matrix.rows(), matrix.cols()));
  Eigen::Index rank = 0;
  while (rank < range.cols()) {
    const Eigen::RowVectorXd left = matrix.colwise().squaredNorm();
    if (left.sum() <= allowed) break;
    std::vector<Eigen::Index> longest(static_cast<std::size_t>(left.size()));
    std::iota(longest.begin(), longest.end(), Eigen::Index{0});
    const Eigen::Index n_taken = std::min(at_once, range.cols() - rank);
    std::partial_sort(longest.begin(), longest.begin() + n_taken, longest.end(),
                      [&](const Eigen::Index a, const Eigen::Index b) { return left(a) > left(b); });
    MatrixXd taken(matrix.rows(), n_taken);
    for (Eigen::Index k = 0; k < n_taken; ++k) taken.col(k) = matrix.col(longest[static_cast<std::size_t>(k)]);
    taken -= range.leftCols(rank) * (range.leftCols(rank).transpose() * taken);  // against rounding
    Eigen::ColPivHouseholderQR<MatrixXd> qr(taken);
    qr.setThreshold(1e-3);  // columns alike are one direction
    if (qr.rank() == 0) break;
    const MatrixXd directions = qr.householderQ() * MatrixXd::Identity(matrix.rows(), qr.rank());
    matrix -= directions * (directions.transpose() * matrix);
    range.middleCols(rank, directions.cols()) = directions;
    rank += directions.cols();
  }
  return range.leftCols(rank);
}

}  // namespace

SingularValues find_singular_values(const MatrixXd& matrix) {
  SKEIN_REQUIRE(matrix.rows() == matrix.cols(), "a square matrix");
  // With A P = Q R, the transpose of R is nearly diagonal, and Jacobi's rotations need few sweeps.
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(matrix);
  const MatrixXd triangle = qr.matrixR().triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<MatrixXd, Eigen::NoQRPreconditioner> svd(triangle.transpose(),
                                                                  Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {qr.householderQ() * svd.matrixV(), qr.colsPermutation() * svd.matrixU(), svd.singularValues()};
}

MatrixXd leading_range(const MatrixXd& matrix, const double tolerance) {
  const double allowed = std::pow(std::max(tolerance, 1e-14) * matrix.norm(), 2);
  const MatrixXd range = find_range(matrix, 0.1 * allowed);
  const Eigen::HouseholderQR<MatrixXd> qr(matrix.transpose() * range);
  const MatrixXd triangle = qr.matrixQR().topRows(range.cols()).triangularView<Eigen::Upper>();
  const SingularValues svd = find_singular_values(triangle.transpose());
  Eigen::Index rank = range.cols();
  for (double lost = 0.0; rank > 1; --rank) {
    lost += std::pow(svd.s(rank - 1), 2);
    if (lost > 0.9 * allowed) break;
  }
  return range * svd.u.leftCols(rank);
}

}  // namespace skein
