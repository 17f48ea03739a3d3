#pragma once

#include <skein/fmm/fmm_plan.hpp>

#include "fmm/fmm_operator_set.hpp"
#include "fmm/tail_algebra.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace skein {

/// The operators of TailField for one degree, kept between calls. The field is homogeneous: they serve all levels.
template <class Real>
class TailOperators {
 public:
  /// One set for every level from first_far_level on, null above.
  /// @param transfers  bit i: those with transfer_index i are needed
  std::vector<const OperatorSet<Real>*> require(int degree, int n_levels, std::uint64_t transfers);
  double bytes() const;

 private:
  void begin(int degree);

  int degree_ = 0;
  std::unique_ptr<TailAlgebra> algebra_;
  OperatorSet<Real> set_;
};

}  // namespace skein
