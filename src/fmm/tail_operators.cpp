#include "fmm/tail_operators.hpp"

#include "fmm/blob_tail.hpp"
#include "fmm/padded_copies.hpp"

namespace skein {
namespace {

/// That thin transfers may lose, by degree, relative to the transfer between nearest boxes: a fifth of what the
/// polynomials miss there.
constexpr double thin_tolerance[most_tail_degree + 1] = {0.1, 0.06, 0.03, 0.012, 0.005, 0.0016, 6e-4, 2e-4, 8e-5};

}  // namespace

template <class Real>
void TailOperators<Real>::begin(const int degree) {
  algebra_ = std::make_unique<TailAlgebra>(degree);
  degree_ = degree;
  set_ = {};
  set_surface<Real>(algebra_->points() / inner_surface, set_);  // the passes ask for points of the inner surface
  std::vector<int> parity;
  for (int row = 0; row < algebra_->rank(); ++row) parity.push_back(algebra_->parity(row));
  set_signs(parity, set_);
  const Eigen::MatrixXd to_points = algebra_->to_points(), up = algebra_->make_pass_up();
  set_.source_density = to_padded_planes<Real>(to_points, set_.n_surface, set_.n_padded);
  set_.to_target = to_padded_plane_columns<Real>(to_points.transpose(), set_.n_surface, set_.n_padded);
  set_.to_parent = to_padded<Real>(up);
  set_.to_child = to_padded<Real>(8.0 * up.transpose());  // 1 / half-width in place of its fourth power
}

template <class Real>
std::vector<const OperatorSet<Real>*> TailOperators<Real>::require(const int degree, const int n_levels,
                                                                   const std::uint64_t transfers) {
  if (degree_ != degree) begin(degree);
  require_transfers<Real>(
      transfers, [&](const int index) { return algebra_->make_transfer(index, thin_tolerance[degree]); }, set_);
  std::vector<const OperatorSet<Real>*> levels(static_cast<std::size_t>(n_levels), &set_);
  for (int level = 0; level < math::smaller(first_far_level, n_levels); ++level)
    levels[static_cast<std::size_t>(level)] = nullptr;
  return levels;
}

template <class Real>
double TailOperators<Real>::bytes() const {
  return bytes_of(set_);
}

template class TailOperators<double>;
template class TailOperators<float>;

}  // namespace skein
