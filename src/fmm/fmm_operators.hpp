#pragma once

#include <skein/fmm/fmm_plan.hpp>

#include "fmm/fmm_operator_set.hpp"

#include <Eigen/Dense>

#include <cstdint>
#include <vector>

namespace skein {

/// Points of the surface of the cube |x| = 1 with `order` points per edge: 6 (order - 1)^2 + 2 in all.
Eigen::MatrixX3d make_surface(int order);

/// The operators of one far field at one ratio of blob to half-width, in double precision, and their copies as Reals
/// for the passes. Source: Ying, Biros, Zorin (2004) for the surfaces; the factors see OperatorSet.
template <class Real>
class FmmOperators {
 public:
  /// @param blob    regularization length in half-widths, for FarField::regularized; else unused
  /// @param cutoff             singular values below cutoff times the largest are dropped
  /// @param transfer_tolerance  of transfers, that may be lost by taking them apart; relative (Frobenius norm)
  FmmOperators(FarField far_field, int order, double cutoff, double transfer_tolerance, double blob);

  /// Builds the transfers whose bit is set and that do not exist yet.
  void require_transfers(std::uint64_t met);

  /// Builds the operators between this level and the one below.
  void require_passes(const FmmOperators& below);

  const OperatorSet<Real>& set() const { return set_; }
  double bytes() const;

 private:
  void decompose(double cutoff);
  Eigen::MatrixXd transfer_matrix(int index) const;
  struct Thin {
    Eigen::MatrixXd last, first;
  };
  Thin take_apart(const Eigen::MatrixXd& transfer) const;
  /// Potentials at `to` of densities at `from`, both [n, 3].
  Eigen::MatrixXd interaction(const Eigen::MatrixX3d& to, const Eigen::MatrixX3d& from) const;
  /// Columns or rows of planes at stride n_padded.
  PaddedMatrix<Real> with_plane_rows(const Eigen::MatrixXd& matrix) const;
  PaddedMatrix<Real> with_plane_columns(const Eigen::MatrixXd& matrix) const;

  FarField far_field_;
  double blob_;
  double transfer_tolerance_;
  int n_components_;
  Eigen::MatrixX3d surface_;
  Eigen::MatrixXd inner_;   ///< V S^(-1/2): densities on the inner surface, [n_components n_surface, rank]
  Eigen::MatrixXd outer_;   ///< U S^(-1/2): densities on the outer surface
  Eigen::VectorXd weight_;  ///< S^(-1/2), padded rank not included
  OperatorSet<Real> set_;
};

}  // namespace skein
