#include "fmm_operators.hpp"

#include "fmm/padded_copies.hpp"

#include <vector>

namespace skein {
namespace {

using Eigen::MatrixXd;

using OneByOne = Kokkos::RangePolicy<HostSpace, Kokkos::Schedule<Kokkos::Dynamic>>;

}  // namespace

template <class Real>
FmmOperators<Real>::FmmOperators(const FarField far_field, const int order, const double cutoff,
                                 const double transfer_tolerance, const double blob)
    : algebra_(far_field, order, blob), transfer_tolerance_(transfer_tolerance) {
  set_surface(algebra_.surface(), set_);
  decompose(cutoff);
  set_.to_source = to_padded_plane_columns<Real>(algebra_.outer().transpose(), set_.n_surface, set_.n_padded);
  set_.to_target = to_padded_plane_columns<Real>(algebra_.inner().transpose(), set_.n_surface, set_.n_padded);
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
  set_signs(algebra_.keep(factors, cutoff), set_);
}

template <class Real>
void FmmOperators<Real>::require_transfers(const std::uint64_t met) {
  const auto make = [&](const int index) {
    return algebra_.make_transfer(index, transfer_tolerance_, padded<Real>(1));
  };
  skein::require_transfers<Real>(met, make, set_);
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
  return bytes_of(set_) + 8.0 * static_cast<double>(algebra_.inner().size() + algebra_.outer().size());
}

template class FmmOperators<double>;
template class FmmOperators<float>;

}  // namespace skein
