#include "fmm_operators.hpp"

#include <skein/core/error.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace skein {
namespace {

using Eigen::MatrixX3d;
using Eigen::MatrixXd;

template <class Real>
PaddedMatrix<Real> make_padded(const int n_rows, const int n_columns) {
  PaddedMatrix<Real> result;
  result.n_rows = padded<Real>(n_rows);
  result.n_columns = n_columns;
  result.entry = Kokkos::View<Real*, HostSpace>(
      "operator", static_cast<std::size_t>(result.n_rows) * static_cast<std::size_t>(n_columns));
  return result;
}

template <class Real>
void fill(const PaddedMatrix<Real>& result, const MatrixXd& matrix) {
  for (int j = 0; j < result.n_columns; ++j)
    for (int i = 0; i < matrix.rows(); ++i)
      result.entry(static_cast<std::size_t>(j) * static_cast<std::size_t>(result.n_rows) +
                   static_cast<std::size_t>(i)) = static_cast<Real>(matrix(i, j));
}

template <class Real>
PaddedMatrix<Real> to_padded(const MatrixXd& matrix) {
  const auto result = make_padded<Real>(static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols()));
  fill(result, matrix);
  return result;
}

/// Orthonormal functions on the surface with one parity: bit c of `parity` is set where they are odd along axis c.
MatrixXd make_parity_basis(const MatrixX3d& surface, const int parity) {
  std::vector<Eigen::VectorXd> basis;
  const auto n = surface.rows();
  for (Eigen::Index i = 0; i < n; ++i) {
    bool represents_orbit = true;
    for (int c = 0; c < 3; ++c)
      represents_orbit &= surface(i, c) > 1e-9 || (std::abs(surface(i, c)) <= 1e-9 && (parity >> c & 1) == 0);
    if (!represents_orbit) continue;
    Eigen::VectorXd function = Eigen::VectorXd::Zero(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      if ((surface.row(j).cwiseAbs() - surface.row(i)).norm() > 1e-9) continue;
      int odd = 0;
      for (int c = 0; c < 3; ++c) odd += (parity >> c & 1) == 1 && surface(j, c) < -1e-9;
      function(j) = odd % 2 == 0 ? 1.0 : -1.0;
    }
    basis.push_back(function.normalized());
  }
  MatrixXd result(n, static_cast<Eigen::Index>(basis.size()));
  for (std::size_t k = 0; k < basis.size(); ++k) result.col(static_cast<Eigen::Index>(k)) = basis[k];
  return result;
}

/// The columns of A that stick out most, orthonormal, a few at once, until less than `allowed` (squared Frobenius norm)
/// is left of A.
MatrixXd find_range(MatrixXd matrix, const double allowed) {
  constexpr Eigen::Index at_once = 16;
  MatrixXd range(matrix.rows(), std::min(matrix.rows(), matrix.cols()));
  Eigen::Index rank = 0;
  while (rank < range.cols()) {
    const Eigen::RowVectorXd left = matrix.colwise().squaredNorm();
    if (left.sum() <= allowed) break;
    std::vector<Eigen::Index> longest(static_cast<std::size_t>(left.size()));
    std::iota(longest.begin(), longest.end(), Eigen::Index{0});
    const Eigen::Index n_taken = std::min(at_once, range.cols() - rank);
    std::partial_sort(longest.begin(), longest.begin() + n_taken, longest.end(),
                      [&](const Eigen::Index a, const Eigen::Index b) { return left(a) > left(b); });
    MatrixXd taken(matrix.rows(), n_taken);
    for (Eigen::Index k = 0; k < n_taken; ++k) taken.col(k) = matrix.col(longest[static_cast<std::size_t>(k)]);
    taken -= range.leftCols(rank) * (range.leftCols(rank).transpose() * taken);  // against rounding
    Eigen::ColPivHouseholderQR<MatrixXd> qr(taken);
    qr.setThreshold(1e-3);  // columns alike are one direction
    if (qr.rank() == 0) break;
    const MatrixXd directions = qr.householderQ() * MatrixXd::Identity(matrix.rows(), qr.rank());
    matrix -= directions * (directions.transpose() * matrix);
    range.middleCols(rank, directions.cols()) = directions;
    rank += directions.cols();
  }
  return range.leftCols(rank);
}

/// The fewest orthonormal columns Q with |A - Q Q^T A| <= tolerance |A| (Frobenius).
MatrixXd leading_range(const MatrixXd& matrix, const double tolerance) {
  const double allowed = std::pow(std::max(tolerance, 1e-14) * matrix.norm(), 2);
  const MatrixXd range = find_range(matrix, 0.1 * allowed);
  const Eigen::HouseholderQR<MatrixXd> qr(matrix.transpose() * range);
  const MatrixXd triangle = qr.matrixQR().topRows(range.cols()).triangularView<Eigen::Upper>();
  const Eigen::BDCSVD<MatrixXd> svd(triangle.transpose(), Eigen::ComputeThinU);
  Eigen::Index rank = range.cols();
  for (double lost = 0.0; rank > 1; --rank) {
    lost += std::pow(svd.singularValues()(rank - 1), 2);
    if (lost > 0.9 * allowed) break;
  }
  return range * svd.matrixU().leftCols(rank);
}

struct Factors {
  MatrixXd inner, outer;
  Eigen::VectorXd singular;
};

}  // namespace

Eigen::MatrixX3d make_surface(const int order) {
  std::vector<Vec3> points;
  const auto coordinate = [&](const int i) { return -1.0 + 2.0 * i / (order - 1); };
  for (int i = 0; i < order; ++i)
    for (int j = 0; j < order; ++j)
      for (int k = 0; k < order; ++k)
        if (std::min({i, j, k}) == 0 || std::max({i, j, k}) == order - 1)
          points.push_back({coordinate(i), coordinate(j), coordinate(k)});
  MatrixX3d surface(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    surface.row(static_cast<Eigen::Index>(i)) << points[i].x, points[i].y, points[i].z;
  return surface;
}

template <class Real>
FmmOperators<Real>::FmmOperators(const FarField far_field, const int order, const double cutoff,
                                 const double transfer_tolerance, const double blob)
    : far_field_(far_field),
      blob_(far_field == FarField::regularized ? blob : 0.0),
      transfer_tolerance_(transfer_tolerance),
      n_components_(far_field == FarField::harmonic ? 1 : 3),
      surface_(make_surface(order)) {
  SKEIN_REQUIRE(order >= 2, "a surface needs two points per edge");
  set_.n_surface = static_cast<int>(surface_.rows());
  set_.n_padded = padded<Real>(set_.n_surface);
  set_.surface = Kokkos::View<Real* [3], Kokkos::LayoutLeft, HostSpace>("surface", set_.n_padded);
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < set_.n_padded; ++i)
      set_.surface(i, c) = static_cast<Real>(surface_(std::min(i, set_.n_surface - 1), c));
  decompose(cutoff);
  set_.to_source = with_plane_columns(outer_.transpose());
  set_.to_target = with_plane_columns(inner_.transpose());
  set_.source_density = with_plane_rows(inner_);
  set_.target_density = with_plane_rows(outer_);
}

template <class Real>
Eigen::MatrixXd FmmOperators<Real>::interaction(const MatrixX3d& to, const MatrixX3d& from) const {
  const Eigen::Index n_to = to.rows(), n_from = from.rows();
  MatrixXd result(n_components_ * n_to, n_components_ * n_from);
  for (Eigen::Index j = 0; j < n_from; ++j)
    for (Eigen::Index i = 0; i < n_to; ++i) {
      const Eigen::RowVector3d d = to.row(i) - from.row(j);
      const double r_squared = d.squaredNorm();
      if (n_components_ == 1) {
        result(i, j) = 1.0 / std::sqrt(r_squared);
        continue;
      }
      const double core_squared = r_squared + blob_ * blob_;
      const double along = 1.0 / (core_squared * std::sqrt(core_squared));
      const double isotropic = along * (core_squared + blob_ * blob_);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          result(a * n_to + i, b * n_from + j) = (a == b ? isotropic : 0.0) + along * d(a) * d(b);
    }
  return result;
}

template <class Real>
void FmmOperators<Real>::decompose(const double cutoff) {
  const Eigen::Index n = surface_.rows();
  const MatrixXd kernel = interaction(outer_surface * surface_, inner_surface * surface_);
  std::vector<MatrixXd> scalar_basis(8);
  std::vector<Factors> factors(8);
  for (int parity = 0; parity < 8; ++parity)
    scalar_basis[static_cast<std::size_t>(parity)] = make_parity_basis(surface_, parity);
  const int n_components = n_components_;
  Kokkos::parallel_for(
      "skein::decompose_surface_kernel",
      Kokkos::RangePolicy<HostSpace, Kokkos::Schedule<Kokkos::Dynamic>>(HostSpace(), 0, 8, Kokkos::ChunkSize(1)),
      [&](const int parity) {
        // A vector field of a parity has components of other parities: its component along a mirrored axis changes
        // sign.
        std::vector<const MatrixXd*> parts;
        Eigen::Index n_functions = 0;
        for (int c = 0; c < n_components; ++c) {
          parts.push_back(&scalar_basis[static_cast<std::size_t>(n_components == 1 ? parity : parity ^ (1 << c))]);
          n_functions += parts.back()->cols();
        }
        MatrixXd basis = MatrixXd::Zero(n_components * n, n_functions);
        Eigen::Index column = 0;
        for (int c = 0; c < n_components; ++c) {
          const MatrixXd& part = *parts[static_cast<std::size_t>(c)];
          basis.block(c * n, column, n, part.cols()) = part;
          column += part.cols();
        }
        const MatrixXd block = basis.transpose() * (kernel * basis);
        const Eigen::BDCSVD<MatrixXd> svd(block, Eigen::ComputeThinU | Eigen::ComputeThinV);
        auto& factor = factors[static_cast<std::size_t>(parity)];
        factor.singular = svd.singularValues();
        factor.outer = basis * svd.matrixU();
        factor.inner = basis * svd.matrixV();
      });
  double largest = 0.0;
  for (const Factors& factor : factors)
    if (factor.singular.size() > 0) largest = std::max(largest, factor.singular(0));
  int rank = 0;
  std::vector<int> kept(8, 0);
  for (std::size_t parity = 0; parity < 8; ++parity) {
    for (Eigen::Index k = 0; k < factors[parity].singular.size(); ++k)
      kept[parity] += factors[parity].singular(k) > cutoff * largest;
    rank += kept[parity];
  }
  set_.rank = rank;
  set_.rank_padded = padded<Real>(rank);
  set_.sign = Kokkos::View<Real* [8], Kokkos::LayoutLeft, HostSpace>("sign", set_.rank_padded);
  inner_.resize(n_components_ * n, rank);
  outer_.resize(n_components_ * n, rank);
  weight_.resize(rank);
  int place = 0;
  for (unsigned parity = 0; parity < 8; ++parity)
    for (int k = 0; k < kept[parity]; ++k, ++place) {
      const Factors& factor = factors[parity];
      const double weight = 1.0 / std::sqrt(factor.singular(k));
      weight_(place) = weight;
      inner_.col(place) = weight * factor.inner.col(k);
      outer_.col(place) = weight * factor.outer.col(k);
      for (unsigned reflected = 0; reflected < 8; ++reflected)
        set_.sign(place, reflected) = std::popcount(parity & reflected) % 2 == 0 ? Real(1) : Real(-1);
    }
}

template <class Real>
PaddedMatrix<Real> FmmOperators<Real>::with_plane_rows(const MatrixXd& matrix) const {
  MatrixXd spread = MatrixXd::Zero(n_components_ * set_.n_padded, matrix.cols());
  for (int c = 0; c < n_components_; ++c)
    spread.middleRows(c * set_.n_padded, set_.n_surface) = matrix.middleRows(c * set_.n_surface, set_.n_surface);
  return to_padded<Real>(spread);
}

template <class Real>
PaddedMatrix<Real> FmmOperators<Real>::with_plane_columns(const MatrixXd& matrix) const {
  MatrixXd spread = MatrixXd::Zero(matrix.rows(), n_components_ * set_.n_padded);
  for (int c = 0; c < n_components_; ++c)
    spread.middleCols(c * set_.n_padded, set_.n_surface) = matrix.middleCols(c * set_.n_surface, set_.n_surface);
  return to_padded<Real>(spread);
}

/// Potentials of the source box's coefficients, for its centre at `transfer` cells from the target box.
template <class Real>
MatrixXd FmmOperators<Real>::transfer_matrix(const int index) const {
  MatrixX3d from = inner_surface * surface_;
  const int transfer[3] = {index & 3, index >> 2 & 3, index >> 4};
  for (int c = 0; c < 3; ++c) from.col(c).array() += 2.0 * transfer[c];
  return inner_.transpose() * (interaction(inner_surface * surface_, from) * inner_);
}

/// Between orthonormal densities a transfer has few large singular values: distant boxes see little of each other.
template <class Real>
typename FmmOperators<Real>::Thin FmmOperators<Real>::take_apart(const MatrixXd& transfer) const {
  const auto unweighted = weight_.cwiseInverse().asDiagonal();
  const MatrixXd densities = unweighted * transfer * unweighted;
  const MatrixXd range = leading_range(densities, transfer_tolerance_);
  return {weight_.asDiagonal() * range, range.transpose() * densities * weight_.asDiagonal()};
}

template <class Real>
void FmmOperators<Real>::require_transfers(const std::uint64_t met) {
  std::vector<int> missing;
  for (int index = 0; index < n_transfers; ++index)
    if ((met >> index & 1) != 0 && set_.transfer[index].empty()) missing.push_back(index);
  if (missing.empty()) return;
  std::vector<Thin> factors(missing.size());
  Kokkos::parallel_for("skein::build_transfers",
                       Kokkos::RangePolicy<HostSpace, Kokkos::Schedule<Kokkos::Dynamic>>(
                           HostSpace(), 0, static_cast<int>(missing.size()), Kokkos::ChunkSize(1)),
                       [&](const int k) {
                         const auto at = static_cast<std::size_t>(k);
                         const MatrixXd transfer = transfer_matrix(missing[at]);
                         Thin thin = take_apart(transfer);
                         // Rows are padded, and two products have their own cost.
                         const bool is_thin = 2.2 * padded<Real>(static_cast<int>(thin.first.rows())) < set_.rank;
                         factors[at] = is_thin ? std::move(thin) : Thin{transfer, {}};
                       });
  for (std::size_t k = 0; k < missing.size(); ++k) {  // no View may be made inside a parallel loop
    auto& transfer = set_.transfer[missing[k]];
    transfer.last = to_padded<Real>(factors[k].last);
    if (factors[k].first.size() > 0) transfer.first = to_padded<Real>(factors[k].first);
  }
}

template <class Real>
void FmmOperators<Real>::require_passes(const FmmOperators& below) {
  if (!set_.to_parent.empty()) return;
  MatrixX3d child = 0.5 * inner_surface * surface_;
  child.array() += 0.5;
  const MatrixXd kernel = interaction(outer_surface * surface_, child);
  const MatrixXd up = outer_.transpose() * (kernel * below.inner_);
  set_.to_parent = to_padded<Real>(up);
  // The kernels are symmetric and of degree -1 in lengths, which double from child to parent.
  set_.to_child = to_padded<Real>(0.5 * up.transpose());
}

template <class Real>
double FmmOperators<Real>::bytes() const {
  double n = 0.0;
  for (const auto* matrix :
       {&set_.to_source, &set_.to_target, &set_.source_density, &set_.target_density, &set_.to_parent, &set_.to_child})
    n += static_cast<double>(matrix->entry.size());
  for (const auto& matrix : set_.transfer)
    n += static_cast<double>(matrix.last.entry.size() + matrix.first.entry.size());
  return n * sizeof(Real) + 8.0 * static_cast<double>(inner_.size() + outer_.size());
}

template class FmmOperators<double>;
template class FmmOperators<float>;

}  // namespace skein
