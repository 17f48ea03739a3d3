#include "fmm_operators.hpp"

#include "fmm/padded_copies.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace skein {
namespace {

using Eigen::MatrixXd;

using OneByOne = Kokkos::RangePolicy<HostSpace, Kokkos::Schedule<Kokkos::Dynamic>>;

}  // namespace

template <class Real>
FmmOperators<Real>::FmmOperators(const FarField far_field, const int order, const double cutoff,
                                 const double transfer_tolerance, const double blob)
    : algebra_(far_field, order, blob), transfer_tolerance_(transfer_tolerance) {
  set_.n_surface = algebra_.n_surface();
  set_.n_padded = padded<Real>(set_.n_surface);
  set_.surface = Kokkos::View<Real* [3], Kokkos::LayoutLeft, HostSpace>("skein::FmmOperators::surface", set_.n_padded);
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < set_.n_padded; ++i)
      set_.surface(i, c) = static_cast<Real>(algebra_.surface()(std::min(i, set_.n_surface - 1), c));
  decompose(cutoff);
  set_.to_source = with_plane_columns(algebra_.outer().transpose());
  set_.to_target = with_plane_columns(algebra_.inner().transpose());
  set_.source_density = to_padded_planes<Real>(algebra_.inner(), set_.n_surface, set_.n_padded);
  set_.target_density = to_padded_planes<Real>(algebra_.outer(), set_.n_surface, set_.n_padded);
}

template <class Real>
void FmmOperators<Real>::decompose(const double cutoff) {
  constexpr int n_parities = SurfaceOperators::n_parities;
  std::vector<SurfaceOperators::Factors> factors(n_parities);
  Kokkos::parallel_for(
      "skein::decompose_surface_kernel", OneByOne(HostSpace(), 0, n_parities, Kokkos::ChunkSize(1)),
      [&](const int parity) { factors[static_cast<std::size_t>(parity)] = algebra_.factor_parity(parity); });
  const std::vector<int> parity_of = algebra_.keep(factors, cutoff);
  set_.rank = algebra_.rank();
  set_.rank_padded = padded<Real>(set_.rank);
  set_.sign = Kokkos::View<Real* [8], Kokkos::LayoutLeft, HostSpace>("skein::FmmOperators::sign", set_.rank_padded);
  for (int place = 0; place < set_.rank; ++place)
    for (unsigned reflected = 0; reflected < 8; ++reflected) {
      const auto parity = static_cast<unsigned>(parity_of[static_cast<std::size_t>(place)]);
      set_.sign(place, reflected) = std::popcount(parity & reflected) % 2 == 0 ? Real(1) : Real(-1);
    }
}

template <class Real>
PaddedMatrix<Real> FmmOperators<Real>::with_plane_columns(const MatrixXd& matrix) const {
  MatrixXd spread = MatrixXd::Zero(matrix.rows(), algebra_.n_components() * set_.n_padded);
  for (int c = 0; c < algebra_.n_components(); ++c)
    spread.middleCols(c * set_.n_padded, set_.n_surface) = matrix.middleCols(c * set_.n_surface, set_.n_surface);
  return to_padded<Real>(spread);
}

template <class Real>
void FmmOperators<Real>::require_transfers(const std::uint64_t met) {
  std::vector<int> missing;
  for (int index = 0; index < n_transfers; ++index)
    if ((met >> index & 1) != 0 && set_.transfer[index].empty()) missing.push_back(index);
  if (missing.empty()) return;
  std::vector<ThinMatrices> factors(missing.size());
  Kokkos::parallel_for("skein::build_transfers",
                       OneByOne(HostSpace(), 0, static_cast<int>(missing.size()), Kokkos::ChunkSize(1)),
                       [&](const int k) {
                         const auto at = static_cast<std::size_t>(k);
                         factors[at] = algebra_.make_transfer(missing[at], transfer_tolerance_, padded<Real>(1));
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
  const MatrixXd up = algebra_.make_pass_up(below.algebra_);
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
  return n * sizeof(Real) + 8.0 * static_cast<double>(algebra_.inner().size() + algebra_.outer().size());
}

template class FmmOperators<double>;
template class FmmOperators<float>;

}  // namespace skein
