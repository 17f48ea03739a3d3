#pragma once

#include "fmm/fmm_operator_set.hpp"
#include "fmm/surface_operators.hpp"

#include <cstdint>
#include <vector>

namespace skein {

/// The operators of one far field at one ratio of blob to half-width, in double precision, and their copies as Reals
/// for the passes.
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

  SurfaceOperators algebra_;
  double transfer_tolerance_;
  OperatorSet<Real> set_;
};

}  // namespace skein
