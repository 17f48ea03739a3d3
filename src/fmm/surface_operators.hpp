#pragma once

#include <skein/fmm/fmm_plan.hpp>

#include "fmm/thin_factors.hpp"

#include <Eigen/Dense>

#include <vector>

namespace skein {

/// Points of the surface of the cube |x| = 1 with `order` points per edge: 6 (order - 1)^2 + 2 in all.
Eigen::MatrixX3d make_surface(int order);

/// The operators of one far field at one ratio of blob to half-width, in double precision: the algebra behind
/// FmmOperators, which runs the loops over parities and transfers and keeps copies as the passes want them. Source:
/// Ying, Biros, Zorin (2004) for the surfaces; the factors see OperatorSet.
///
/// Apart from its user for the compiler's sake: Eigen's decompositions are compiled once, and by the host's compiler.
class SurfaceOperators {
 public:
  /// @param blob  regularization length in half-widths, for FarField::regularized; else unused
  SurfaceOperators(FarField far_field, int order, double blob);

  int n_surface() const { return static_cast<int>(surface_.rows()); }
  int n_components() const { return n_components_; }  ///< of a density: 1 where all planes share one operator
  int rank() const { return static_cast<int>(weight_.size()); }
  const Eigen::MatrixX3d& surface() const { return surface_; }
  /// V S^(-1/2), densities on the inner surface, and U S^(-1/2), on the outer one: [n_components n_surface, rank].
  const Eigen::MatrixXd& inner() const { return inner_; }
  const Eigen::MatrixXd& outer() const { return outer_; }

  static constexpr int n_parities = 8;
  /// The singular values of the kernel between the surfaces that belong to one parity, with their vectors.
  struct Factors {
    Eigen::MatrixXd inner, outer;
    Eigen::VectorXd singular;
  };
  Factors factor_parity(int parity) const;

  /// Keeps what is above `cutoff` times the largest singular value. @returns the parity of each row kept, [rank]
  std::vector<int> keep(const std::vector<Factors>& factors, double cutoff);

  /// Potentials of a source box's coefficients, for its centre at the transfer `index` (see transfer_index) from the
  /// target box, as two thin matrices where that is cheaper.
  /// @param tolerance  that may be lost by taking it apart; relative (Frobenius norm)
  /// @param row_unit   rows are padded to multiples of this
  ThinMatrices make_transfer(int index, double tolerance, int row_unit) const;

  /// From the coefficients of a child, whose operators are `below`, to its parent's: [rank, rank of below].
  Eigen::MatrixXd make_pass_up(const SurfaceOperators& below) const;

 private:
  /// Potentials at `to` of densities at `from`, both [n, 3].
  Eigen::MatrixXd interaction(const Eigen::MatrixX3d& to, const Eigen::MatrixX3d& from) const;
  ThinMatrices take_apart(const Eigen::MatrixXd& transfer, double tolerance) const;

  double blob_;
  int n_components_;
  Eigen::MatrixX3d surface_;
  Eigen::MatrixXd kernel_;                     ///< from the inner to the outer surface, until keep()
  std::vector<Eigen::MatrixXd> parity_basis_;  ///< [n_parities], until keep()
  Eigen::MatrixXd inner_, outer_;
  Eigen::VectorXd weight_;  ///< S^(-1/2), [rank]
};

}  // namespace skein
