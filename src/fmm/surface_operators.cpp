#include "surface_operators.hpp"

#include <skein/core/error.hpp>

#include "box_surfaces.hpp"
#include "thin_factors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace skein {
namespace {

using Eigen::MatrixX3d;
using Eigen::MatrixXd;

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

}  // namespace

Eigen::MatrixX3d make_surface(const int order) {
  std::vector<Eigen::RowVector3d> points;
  const auto coordinate = [&](const int i) { return -1.0 + 2.0 * i / (order - 1); };
  for (int i = 0; i < order; ++i)
    for (int j = 0; j < order; ++j)
      for (int k = 0; k < order; ++k)
        if (std::min({i, j, k}) == 0 || std::max({i, j, k}) == order - 1)
          points.emplace_back(coordinate(i), coordinate(j), coordinate(k));
  MatrixX3d surface(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) surface.row(static_cast<Eigen::Index>(i)) = points[i];
  return surface;
}

SurfaceOperators::SurfaceOperators(const FarField far_field, const int order, const double blob)
    : blob_(far_field == FarField::regularized ? blob : 0.0),
      n_components_(far_field == FarField::harmonic ? 1 : 3),
      surface_(make_surface(order)) {
  SKEIN_REQUIRE(order >= 2, "a surface needs two points per edge");
  kernel_ = interaction(outer_surface * surface_, inner_surface * surface_);
  for (int parity = 0; parity < n_parities; ++parity) parity_basis_.push_back(make_parity_basis(surface_, parity));
}

MatrixXd SurfaceOperators::interaction(const MatrixX3d& to, const MatrixX3d& from) const {
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

SurfaceOperators::Factors SurfaceOperators::factor_parity(const int parity) const {
  // A vector field of a parity has components of other parities: its component along a mirrored axis changes sign.
  const Eigen::Index n = surface_.rows();
  std::vector<const MatrixXd*> parts;
  Eigen::Index n_functions = 0;
  for (int c = 0; c < n_components_; ++c) {
    parts.push_back(&parity_basis_[static_cast<std::size_t>(n_components_ == 1 ? parity : parity ^ (1 << c))]);
    n_functions += parts.back()->cols();
  }
  MatrixXd basis = MatrixXd::Zero(n_components_ * n, n_functions);
  Eigen::Index column = 0;
  for (int c = 0; c < n_components_; ++c) {
    const MatrixXd& part = *parts[static_cast<std::size_t>(c)];
    basis.block(c * n, column, n, part.cols()) = part;
    column += part.cols();
  }
  const MatrixXd block = basis.transpose() * (kernel_ * basis);
  const SingularValues svd = find_singular_values(block);
  return {basis * svd.v, basis * svd.u, svd.s};
}

std::vector<int> SurfaceOperators::keep(const std::vector<Factors>& factors, const double cutoff) {
  SKEIN_REQUIRE(factors.size() == n_parities, "the factors of all parities");
  double largest = 0.0;
  for (const Factors& factor : factors)
    if (factor.singular.size() > 0) largest = std::max(largest, factor.singular(0));
  std::vector<int> parity_of;
  std::vector<std::pair<Eigen::VectorXd, Eigen::VectorXd>> columns;
  std::vector<double> weights;
  for (int parity = 0; parity < n_parities; ++parity) {
    const Factors& factor = factors[static_cast<std::size_t>(parity)];
    Eigen::Index n_kept = 0;
    for (Eigen::Index k = 0; k < factor.singular.size(); ++k) n_kept += factor.singular(k) > cutoff * largest;
    for (Eigen::Index k = 0; k < n_kept; ++k) {
      const double weight = 1.0 / std::sqrt(factor.singular(k));
      weights.push_back(weight);
      columns.emplace_back(weight * factor.inner.col(k), weight * factor.outer.col(k));
      parity_of.push_back(parity);
    }
  }
  const auto n_kept = static_cast<Eigen::Index>(columns.size());
  inner_.resize(n_components_ * surface_.rows(), n_kept);
  outer_.resize(n_components_ * surface_.rows(), n_kept);
  for (Eigen::Index k = 0; k < n_kept; ++k) {
    inner_.col(k) = columns[static_cast<std::size_t>(k)].first;
    outer_.col(k) = columns[static_cast<std::size_t>(k)].second;
  }
  weight_ = Eigen::Map<const Eigen::VectorXd>(weights.data(), n_kept);
  kernel_.resize(0, 0);
  parity_basis_.clear();
  return parity_of;
}

ThinMatrices SurfaceOperators::make_transfer(const int index, const double tolerance, const int row_unit) const {
  MatrixX3d from = inner_surface * surface_;
  const int place[3] = {index & 3, index >> 2 & 3, index >> 4};
  for (int c = 0; c < 3; ++c) from.col(c).array() += 2.0 * place[c];
  const MatrixXd transfer = inner_.transpose() * (interaction(inner_surface * surface_, from) * inner_);
  ThinMatrices thin = take_apart(transfer, tolerance);
  // Rows are padded, and two products have their own cost.
  const auto thin_rows = static_cast<int>(thin.first.rows());
  const int padded_rows = (thin_rows + row_unit - 1) / row_unit * row_unit;
  if (2.2 * padded_rows < rank()) return thin;
  return {transfer, {}};
}

/// Between orthonormal densities a transfer has few large singular values: distant boxes see little of each other.
ThinMatrices SurfaceOperators::take_apart(const MatrixXd& transfer, const double tolerance) const {
  const auto unweighted = weight_.cwiseInverse().asDiagonal();
  const MatrixXd densities = unweighted * transfer * unweighted;
  const MatrixXd range = leading_range(densities, tolerance);
  return {weight_.asDiagonal() * range, range.transpose() * densities * weight_.asDiagonal()};
}

MatrixXd SurfaceOperators::make_pass_up(const SurfaceOperators& below) const {
  MatrixX3d child = 0.5 * inner_surface * surface_;
  child.array() += 0.5;
  const MatrixXd kernel = interaction(outer_surface * surface_, child);
  return outer_.transpose() * (kernel * below.inner_);
}

}  // namespace skein
