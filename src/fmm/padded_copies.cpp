#include "fmm/padded_copies.hpp"

#include <algorithm>
#include <bit>

namespace skein {

using Eigen::Index;
using Eigen::MatrixXd;

template <class Real>
PaddedMatrix<Real> to_padded(const MatrixXd& matrix) {
  PaddedMatrix<Real> result;
  result.n_rows = padded<Real>(static_cast<int>(matrix.rows()));
  result.n_columns = static_cast<int>(matrix.cols());
  result.entry =
      Kokkos::View<Real*, HostSpace>("skein::padded_copies::entry", static_cast<std::size_t>(result.n_rows) *
                                                                        static_cast<std::size_t>(result.n_columns));
  for (int j = 0; j < result.n_columns; ++j)
    for (int i = 0; i < matrix.rows(); ++i)
      result.entry(static_cast<std::size_t>(j) * static_cast<std::size_t>(result.n_rows) +
                   static_cast<std::size_t>(i)) = static_cast<Real>(matrix(i, j));
  return result;
}

template <class Real>
PaddedMatrix<Real> to_padded_planes(const MatrixXd& matrix, const int n, const int n_padded) {
  const auto n_planes = matrix.rows() / n;
  MatrixXd spread = MatrixXd::Zero(n_planes * n_padded, matrix.cols());
  for (Index c = 0; c < n_planes; ++c) spread.middleRows(c * n_padded, n) = matrix.middleRows(c * n, n);
  return to_padded<Real>(spread);
}

template <class Real>
PaddedMatrix<Real> to_padded_plane_columns(const MatrixXd& matrix, const int n, const int n_padded) {
  const auto n_planes = matrix.cols() / n;
  MatrixXd spread = MatrixXd::Zero(matrix.rows(), n_planes * n_padded);
  for (Index c = 0; c < n_planes; ++c) spread.middleCols(c * n_padded, n) = matrix.middleCols(c * n, n);
  return to_padded<Real>(spread);
}

template <class Real>
void set_surface(const Eigen::MatrixX3d& points, OperatorSet<Real>& set) {
  set.n_surface = static_cast<int>(points.rows());
  set.n_padded = padded<Real>(set.n_surface);
  set.surface = Kokkos::View<Real* [3], Kokkos::LayoutLeft, HostSpace>("skein::padded_copies::surface", set.n_padded);
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < set.n_padded; ++i)
      set.surface(i, c) = static_cast<Real>(points(std::min(i, set.n_surface - 1), c));
}

template <class Real>
void set_signs(const std::vector<int>& parity, OperatorSet<Real>& set) {
  set.rank = static_cast<int>(parity.size());
  set.rank_padded = padded<Real>(set.rank);
  set.sign = Kokkos::View<Real* [8], Kokkos::LayoutLeft, HostSpace>("skein::padded_copies::sign", set.rank_padded);
  for (int row = 0; row < set.rank; ++row)
    for (unsigned reflected = 0; reflected < 8; ++reflected) {
      const auto odd = static_cast<unsigned>(parity[static_cast<std::size_t>(row)]);
      set.sign(row, reflected) = std::popcount(odd & reflected) % 2 == 0 ? Real(1) : Real(-1);
    }
}

template <class Real>
void require_transfers(const std::uint64_t met, const std::function<ThinMatrices(int)>& make, OperatorSet<Real>& set) {
  std::vector<int> missing;
  for (int index = 0; index < n_transfers; ++index)
    if ((met >> index & 1) != 0 && set.transfer[index].empty()) missing.push_back(index);
  if (missing.empty()) return;
  std::vector<ThinMatrices> factors(missing.size());
  using OneByOne = Kokkos::RangePolicy<HostSpace, Kokkos::Schedule<Kokkos::Dynamic>>;
  Kokkos::parallel_for("skein::require_transfers",
                       OneByOne(HostSpace(), 0, static_cast<int>(missing.size()), Kokkos::ChunkSize(1)),
                       [&](const int k) {
                         const auto at = static_cast<std::size_t>(k);
                         factors[at] = make(missing[at]);
                       });
  for (std::size_t k = 0; k < missing.size(); ++k) {  // no View may be made inside a parallel loop
    auto& transfer = set.transfer[missing[k]];
    transfer.last = to_padded<Real>(factors[k].last);
    if (factors[k].first.size() > 0) transfer.first = to_padded<Real>(factors[k].first);
  }
}

template <class Real>
double bytes_of(const OperatorSet<Real>& set) {
  double n = 0.0;
  for (const auto* matrix :
       {&set.to_source, &set.to_target, &set.source_density, &set.target_density, &set.to_parent, &set.to_child})
    n += static_cast<double>(matrix->entry.size());
  for (const auto& matrix : set.transfer)
    n += static_cast<double>(matrix.last.entry.size() + matrix.first.entry.size());
  return n * sizeof(Real);
}

#define SKEIN_INSTANTIATE(Real)                                                                                \
  template PaddedMatrix<Real> to_padded(const MatrixXd&);                                                      \
  template PaddedMatrix<Real> to_padded_planes(const MatrixXd&, int, int);                                     \
  template PaddedMatrix<Real> to_padded_plane_columns(const MatrixXd&, int, int);                              \
  template void set_surface(const Eigen::MatrixX3d&, OperatorSet<Real>&);                                      \
  template void set_signs(const std::vector<int>&, OperatorSet<Real>&);                                        \
  template void require_transfers(std::uint64_t, const std::function<ThinMatrices(int)>&, OperatorSet<Real>&); \
  template double bytes_of(const OperatorSet<Real>&);
SKEIN_INSTANTIATE(double)
SKEIN_INSTANTIATE(float)
#undef SKEIN_INSTANTIATE  // device builds read several of these sources as one

}  // namespace skein
