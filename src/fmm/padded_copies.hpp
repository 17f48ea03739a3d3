#pragma once

#include "fmm/fmm_operator_set.hpp"
#include "fmm/thin_factors.hpp"

#include <cstdint>
#include <functional>
#include <vector>

// Operators in double precision as the passes want them: padded to whole packs, in either precision. Views are made:
// not inside a parallel loop.

namespace skein {

template <class Real>
PaddedMatrix<Real> to_padded(const Eigen::MatrixXd& matrix);

/// The same with planes of n rows, or of n columns, which begin at multiples of n_padded.
template <class Real>
PaddedMatrix<Real> to_padded_planes(const Eigen::MatrixXd& matrix, int n, int n_padded);
template <class Real>
PaddedMatrix<Real> to_padded_plane_columns(const Eigen::MatrixXd& matrix, int n, int n_padded);

/// Places for OperatorSet::surface and how many they are; the padding repeats the last one.
template <class Real>
void set_surface(const Eigen::MatrixX3d& points, OperatorSet<Real>& set);

/// Signs of coefficients under reflections. @param parity  of each, bit c: odd under reflection of axis c
template <class Real>
void set_signs(const std::vector<int>& parity, OperatorSet<Real>& set);

/// Builds the transfers whose bit is set in `met` and that do not exist yet, in parallel, by make(index).
template <class Real>
void require_transfers(std::uint64_t met, const std::function<ThinMatrices(int)>& make, OperatorSet<Real>& set);

/// Of all matrices.
template <class Real>
double bytes_of(const OperatorSet<Real>& set);

}  // namespace skein
