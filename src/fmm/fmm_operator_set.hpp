#pragma once

#include <skein/arrays/types.hpp>

#include "fmm/box_surfaces.hpp"
#include "fmm/matrix_product.hpp"

namespace skein {

/// A matrix with contiguous columns, its rows padded to whole packs by zeros.
template <class Real>
struct PaddedMatrix {
  Kokkos::View<Real*, HostSpace> entry;
  int n_rows = 0;  ///< padded: also the stride of the columns
  int n_columns = 0;

  bool empty() const { return n_columns == 0; }
};

/// A matrix, or two thin ones whose product is the matrix to within a tolerance, where that takes less work.
template <class Real>
struct FactoredMatrix {
  PaddedMatrix<Real> last, first;  ///< last (first B); only `last` where it is the whole matrix

  bool empty() const { return last.empty(); }
};

/// Boxes of levels above have no far pairs and need no coefficients.
inline constexpr int first_far_level = 2;

// A transfer vector's operator serves its mirror images too: with the axes of its negative components reflected.
inline constexpr int n_transfers = 64;

/// The matrices of the kernel-independent method for one kind of far field, in units of a box's half-width.
///
/// With K = U S V^T from the inner surface's densities to the outer surface's potentials, a box keeps c = S^(-1/2) U^T
/// (potential on its outer surface), cut to the `rank` largest singular values: the two factors of the pseudo-inverse
/// are never multiplied with each other, and small singular values share their weight between the two sides. A target
/// box keeps c = S^(-1/2) V^T (potential on its inner surface). K, U, S, V split by the eight parities under
/// reflections of the axes, so that a reflection only changes the signs of coefficients.
template <class Real>
struct OperatorSet {
  int n_surface = 0;  ///< points of a surface
  int n_padded = 0;   ///< in whole packs; planes of potentials and densities follow each other at this stride
  int rank = 0;
  int rank_padded = 0;
  Kokkos::View<Real* [3], Kokkos::LayoutLeft, HostSpace> surface;  ///< [n_padded, 3], of the cube |x| = 1
  PaddedMatrix<Real> to_source;       ///< potentials on the outer surface -> coefficients of sources
  PaddedMatrix<Real> to_target;       ///< potentials on the inner surface -> coefficients for targets
  PaddedMatrix<Real> source_density;  ///< coefficients of sources -> densities on the inner surface
  PaddedMatrix<Real> target_density;  ///< coefficients for targets -> densities on the outer surface
  PaddedMatrix<Real> to_parent;       ///< from the child at the upper side of all axes (its own operator set's rank)
  PaddedMatrix<Real> to_child;        ///< to that child
  FactoredMatrix<Real> transfer[n_transfers];                   ///< built when first met
  Kokkos::View<Real* [8], Kokkos::LayoutLeft, HostSpace> sign;  ///< [rank_padded, reflected axes], +1 or -1
};

}  // namespace skein
