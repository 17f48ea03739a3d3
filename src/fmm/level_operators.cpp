#include "fmm/level_operators.hpp"

#include <string>
#include <utility>

namespace skein {

template <class Space, class Real>
template <class Array>
const Real* OperatorCopies<Space, Real>::copy_array(const Array& array, Copies& used) const {
  if (array.size() == 0) return nullptr;
  if constexpr (on_host<Space>) {
    used.emplace(array.data(), Copy{std::make_shared<const Array>(array), {}});
    return array.data();
  }
  const auto again = used.find(array.data());
  if (again != used.end()) return again->second.device.data();
  const auto kept = copies_.find(array.data());
  if (kept != copies_.end()) return used.insert(*kept).first->second.device.data();
  // Arrays of columns, one after the other.
  const Kokkos::View<const Real*, Kokkos::HostSpace, Kokkos::MemoryUnmanaged> entries(array.data(), array.size());
  const Kokkos::View<Real*, Space> device(
      Kokkos::view_alloc(std::string("skein::level_operators::operator"), Kokkos::WithoutInitializing), array.size());
  Kokkos::deep_copy(device, entries);
  return used.emplace(array.data(), Copy{std::make_shared<const Array>(array), device}).first->second.device.data();
}

template <class Space, class Real>
Matrix<Real> OperatorCopies<Space, Real>::copy_matrix(const PaddedMatrix<Real>& matrix, Copies& used) const {
  Matrix<Real> result;
  result.entry = copy_array(matrix.entry, used);
  result.n_rows = matrix.n_rows;
  result.n_columns = matrix.n_columns;
  return result;
}

template <class Space, class Real>
LevelOperators<Real> OperatorCopies<Space, Real>::copy_set(const OperatorSet<Real>& set, Copies& used) const {
  LevelOperators<Real> result;
  result.n_surface = set.n_surface;
  result.n_padded = set.n_padded;
  result.rank_padded = set.rank_padded;
  result.surface = copy_array(set.surface, used);
  result.sign = copy_array(set.sign, used);
  result.to_source = copy_matrix(set.to_source, used);
  result.to_target = copy_matrix(set.to_target, used);
  result.source_density = copy_matrix(set.source_density, used);
  result.target_density = copy_matrix(set.target_density, used);
  result.to_parent = copy_matrix(set.to_parent, used);
  result.to_child = copy_matrix(set.to_child, used);
  for (int index = 0; index < n_transfers; ++index) {
    result.transfer_last[index] = copy_matrix(set.transfer[index].last, used);
    result.transfer_first[index] = copy_matrix(set.transfer[index].first, used);
  }
  return result;
}

template <class Space, class Real>
const Levels<Space, Real>& OperatorCopies<Space, Real>::require(const std::vector<const OperatorSet<Real>*>& levels,
                                                                const std::uint64_t transfers) {
  std::vector<const void*> names;
  for (const auto* set : levels) {
    names.push_back(set);
    names.push_back(set == nullptr ? nullptr : set->surface.data());
  }
  if (names == names_ && (transfers & ~transfers_) == 0) return levels_;
  Copies used;
  Levels<Space, Real> result;
  const Kokkos::View<LevelOperators<Real>*, Space> sets("skein::level_operators::operator_sets", levels.size());
  const auto host = Kokkos::create_mirror_view(sets);
  for (std::size_t level = 0; level < levels.size(); ++level) {
    if (levels[level] == nullptr) continue;
    host(level) = copy_set(*levels[level], used);
    result.n_padded = host(level).n_padded;
    result.max_rank_padded = math::larger(result.max_rank_padded, host(level).rank_padded);
    for (const Matrix<Real>& first : host(level).transfer_first)
      result.max_middle = math::larger(result.max_middle, first.n_rows);
  }
  Kokkos::deep_copy(sets, host);
  result.sets = sets;
  copies_ = std::move(used);
  names_ = std::move(names);
  transfers_ = transfers;
  levels_ = result;
  return levels_;
}

template <class Space, class Real>
double OperatorCopies<Space, Real>::bytes() const {
  double sum = 0.0;
  for (const auto& [name, copy] : copies_) sum += static_cast<double>(copy.device.size() * sizeof(Real));
  return sum;
}

#define SKEIN_INSTANTIATE(S)                \
  template class OperatorCopies<S, double>; \
  template class OperatorCopies<S, float>;
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
