#pragma once

#include <Eigen/Dense>

namespace skein {

/// What remains of A = last first, or of A = last where `first` is empty.
struct ThinMatrices {
  Eigen::MatrixXd last, first;
};

/// A = U S V^T, S falling.
struct SingularValues {
  Eigen::MatrixXd u, v;
  Eigen::VectorXd s;
};

/// Of a square matrix [n, n], by Jacobi's rotations, which keep the relative accuracy of small values; Eigen's divide
/// and conquer takes as long to compile as all the rest of this layer.
SingularValues find_singular_values(const Eigen::MatrixXd& matrix);

/// The fewest orthonormal columns Q with |A - Q Q^T A| <= tolerance |A| (Frobenius).
Eigen::MatrixXd leading_range(const Eigen::MatrixXd& matrix, double tolerance);

}  // namespace skein
