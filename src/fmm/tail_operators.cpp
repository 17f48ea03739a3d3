#include "fmm/tail_operators.hpp"

#include "fmm/blob_tail.hpp"
#include "fmm/padded_copies.hpp"

#include <algorithm>
#include <bit>

namespace skein {
namespace {

using OneByOne = Kokkos::RangePolicy<HostSpace, Kokkos::Schedule<Kokkos::Dynamic>>;

/// That thin transfers may lose, by degree, relative to the transfer between nearest boxes: a fifth of what the
/// polynomials miss there.
constexpr double thin_tolerance[most_tail_degree + 1] = {0.1, 0.06, 0.03, 0.012, 0.005, 0.0016, 6e-4, 2e-4, 8e-5};

}  // namespace

template <class Real>
void TailOperators<Real>::begin(const int degree) {
  algebra_ = std::make_unique<TailAlgebra>(degree);
  degree_ = degree;
  set_ = {};
  set_.n_surface = static_cast<int>(algebra_->points().rows());
  set_.n_padded = padded<Real>(set_.n_surface);
  set_.rank = algebra_->rank();
  set_.rank_padded = padded<Real>(set_.rank);
  set_.surface = Kokkos::View<Real* [3], Kokkos::LayoutLeft, HostSpace>("skein::tail_operators::points", set_.n_padded);
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < set_.n_padded; ++i)  // the passes ask for points of the inner surface
      set_.surface(i, c) = static_cast<Real>(algebra_->points()(std::min(i, set_.n_surface - 1), c) / inner_surface);
  set_.sign = Kokkos::View<Real* [8], Kokkos::LayoutLeft, HostSpace>("skein::tail_operators::sign", set_.rank_padded);
  for (int row = 0; row < set_.rank; ++row)
    for (unsigned reflected = 0; reflected < 8; ++reflected)
      set_.sign(row, reflected) =
          std::popcount(static_cast<unsigned>(algebra_->parity(row)) & reflected) % 2 == 0 ? Real(1) : Real(-1);
  const Eigen::MatrixXd to_points = algebra_->to_points(), up = algebra_->make_pass_up();
  set_.source_density = to_padded_planes<Real>(to_points, set_.n_surface, set_.n_padded);
  Eigen::MatrixXd from_points = Eigen::MatrixXd::Zero(set_.rank, 3 * set_.n_padded);
  for (int c = 0; c < 3; ++c)
    from_points.middleCols(c * set_.n_padded, set_.n_surface) =
        to_points.middleRows(c * set_.n_surface, set_.n_surface).transpose();
  set_.to_target = to_padded<Real>(from_points);
  set_.to_parent = to_padded<Real>(up);
  set_.to_child = to_padded<Real>(8.0 * up.transpose());  // 1 / half-width in place of its fourth power
}

template <class Real>
std::vector<const OperatorSet<Real>*> TailOperators<Real>::require(const int degree, const int n_levels,
                                                                   const std::uint64_t transfers) {
  if (degree_ != degree) begin(degree);
  std::vector<int> missing;
  for (int index = 0; index < n_transfers; ++index)
    if ((transfers >> index & 1) != 0 && set_.transfer[index].empty()) missing.push_back(index);
  std::vector<TailAlgebra::Transfer> factors(missing.size());
  Kokkos::parallel_for("skein::build_tail_transfers",
                       OneByOne(HostSpace(), 0, static_cast<int>(missing.size()), Kokkos::ChunkSize(1)),
                       [&](const int k) {
                         const int index = missing[static_cast<std::size_t>(k)];
                         const int place[3] = {index & 3, index >> 2 & 3, index >> 4};
                         factors[static_cast<std::size_t>(k)] = algebra_->make_transfer(place, thin_tolerance[degree]);
                       });
  for (std::size_t k = 0; k < missing.size(); ++k) {
    set_.transfer[missing[k]].last = to_padded<Real>(factors[k].last);
    set_.transfer[missing[k]].first = to_padded<Real>(factors[k].first);
  }
  std::vector<const OperatorSet<Real>*> levels(static_cast<std::size_t>(n_levels), &set_);
  for (int level = 0; level < math::smaller(first_far_level, n_levels); ++level)
    levels[static_cast<std::size_t>(level)] = nullptr;
  return levels;
}

template <class Real>
double TailOperators<Real>::bytes() const {
  double n = 0.0;
  for (const auto* matrix : {&set_.to_target, &set_.source_density, &set_.to_parent, &set_.to_child})
    n += static_cast<double>(matrix->entry.size());
  for (const auto& matrix : set_.transfer)
    n += static_cast<double>(matrix.last.entry.size() + matrix.first.entry.size());
  return n * sizeof(Real);
}

template class TailOperators<double>;
template class TailOperators<float>;

}  // namespace skein
