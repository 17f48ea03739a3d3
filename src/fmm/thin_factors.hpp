#pragma once

#include <Eigen/Dense>

namespace skein {

/// A = U S V^T, thin. Compiled once: Eigen's divide and conquer costs half a minute wherever it is instantiated.
struct SingularValues {
  Eigen::MatrixXd u, v;
  Eigen::VectorXd s;
};

/// @param options  Eigen::ComputeThinU and ComputeThinV: what is wanted besides the values
SingularValues find_singular_values(const Eigen::MatrixXd& matrix, unsigned options);

/// The fewest orthonormal columns Q with |A - Q Q^T A| <= tolerance |A| (Frobenius).
Eigen::MatrixXd leading_range(const Eigen::MatrixXd& matrix, double tolerance);

}  // namespace skein
