#pragma once

#include "fmm/thin_factors.hpp"

#include <Eigen/Dense>

namespace skein {

/// What TailField's operators are made of, in double precision, for coefficients [3][polynomial] and in units of a
/// box's half-width. The velocity of a box's sources at targets of another is replaced by its projection on the
/// polynomials of both, the best for sources and targets anywhere in their boxes (least squares).
class TailAlgebra {
 public:
  explicit TailAlgebra(int degree);

  int rank() const { return 3 * n_polynomials_; }
  /// Gauss's points, dense enough for the polynomials: what sources or targets outside of the list V see of a box.
  const Eigen::MatrixX3d& points() const { return points_; }
  /// Bit c: odd under reflection of axis c.
  int parity(int row) const;

  /// Strengths at the points of a box's moments, [3 n_points, rank]; its transpose makes coefficients of velocities at
  /// the points.
  Eigen::MatrixXd to_points() const;

  /// Thin factors of the operator from a source box's moments to a target box's coefficients.
  /// @param index      transfer_index of the way between the boxes
  /// @param tolerance  that may be lost, relative to the transfer between nearest boxes (Frobenius norm)
  ThinMatrices make_transfer(int index, double tolerance) const;

  /// Moments of a parent from those of the child at the upper side of all axes.
  Eigen::MatrixXd make_pass_up() const;

 private:
  /// The transfer between orthonormal polynomials of a lower degree, by a Gauss rule of as many points an axis as that
  /// has coefficients: [3 n, 3 n].
  Eigen::MatrixXd project(const int (&place)[3], int degree) const;

  int degree_, n_polynomials_;
  Eigen::MatrixX3i powers_;  ///< [n_polynomials, 3]
  Eigen::VectorXd norm_;     ///< of the orthonormal polynomials over those of Legendre, [n_polynomials]
  Eigen::MatrixX3d points_;
  Eigen::MatrixXd at_points_;  ///< orthonormal polynomials times the points' weights, [n_polynomials, n_points]
};

}  // namespace skein
