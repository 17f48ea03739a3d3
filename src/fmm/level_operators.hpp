#pragma once

#include "fmm/fmm_operator_set.hpp"

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace skein {

/// A PaddedMatrix in the memory of a space, for kernels; it owns nothing.
template <class Real>
struct Matrix {
  const Real* entry = nullptr;
  int n_rows = 0;  ///< also the stride of the columns
  int n_columns = 0;
};

/// What kernels see of an OperatorSet; the names are the same.
template <class Real>
struct LevelOperators {
  int n_surface = 0, n_padded = 0, rank_padded = 0;
  const Real* surface = nullptr;  ///< [n_padded, 3], axis after axis
  const Real* sign = nullptr;     ///< [rank_padded, 8], reflection after reflection
  Matrix<Real> to_source, to_target, source_density, target_density, to_parent, to_child;
  Matrix<Real> transfer_last[n_transfers], transfer_first[n_transfers];

  KOKKOS_INLINE_FUNCTION const Real* sign_of(const int reflected) const { return sign + reflected * rank_padded; }
  KOKKOS_INLINE_FUNCTION Real surface_at(const int point, const int axis) const {
    return surface[axis * n_padded + point];
  }
};

/// The operators of the levels of a tree, for kernels; above first_far_level there are none.
template <class Space, class Real>
struct Levels {
  Kokkos::View<const LevelOperators<Real>*, Space> sets;
  int n_padded = 0;         ///< the same at all levels
  int max_rank_padded = 0;  ///< of all levels
  int max_middle = 0;       ///< numbers of a column between two thin factors, of all transfers
};

/// Operators in the memory of a space. A host reads them where they are; elsewhere each is copied when it is first met,
/// and dropped when a call does not ask for it.
template <class Space, class Real>
class OperatorCopies {
 public:
  /// @param levels     of each level of the tree; null where there are none
  /// @param transfers  bit i: transfers with index i are needed; what was copied for the call before serves again where
  ///                   it has them
  const Levels<Space, Real>& require(const std::vector<const OperatorSet<Real>*>& levels, std::uint64_t transfers);
  double bytes() const;

 private:
  struct Copy {
    std::shared_ptr<const void> host;  ///< the array that was copied: while it lives, its place in memory is its name
    Kokkos::View<const Real*, Space> device;
  };
  using Copies = std::unordered_map<const Real*, Copy>;

  template <class Array>
  const Real* copy_array(const Array& array, Copies& used) const;
  Matrix<Real> copy_matrix(const PaddedMatrix<Real>& matrix, Copies& used) const;
  LevelOperators<Real> copy_set(const OperatorSet<Real>& set, Copies& used) const;

  Copies copies_;
  // Of the last call. A surface's array, which a copy keeps, tells a set from one that was made anew in its place.
  std::vector<const void*> names_;
  std::uint64_t transfers_ = 0;
  Levels<Space, Real> levels_;
};

}  // namespace skein
