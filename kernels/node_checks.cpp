#include "kernels/node_checks.hpp"

namespace skein {

template <class Space>
BlobRange find_blob_range(const Space& space, const ConstScalarView<Space>& blob) {
  using Extremes = Kokkos::MinMax<double>;
  typename Extremes::value_type found;
  Kokkos::parallel_reduce(
      "skein::find_blob_range", Kokkos::RangePolicy<Space>(space, 0, blob.extent_int(0)),
      KOKKOS_LAMBDA(const int i, typename Extremes::value_type& extremes) {
        if (blob(i) < extremes.min_val) extremes.min_val = blob(i);
        if (blob(i) > extremes.max_val) extremes.max_val = blob(i);
      },
      Extremes(found));
  return {found.min_val, found.max_val};
}

template <class Space>
bool are_finite(const Space& space, const ConstVectorView<Space>& vectors) {
  int n_faulty = 0;
  Kokkos::parallel_reduce(
      "skein::are_finite", Kokkos::RangePolicy<Space>(space, 0, vectors.extent_int(0)),
      KOKKOS_LAMBDA(const int i, int& sum) {
        for (int c = 0; c < 3; ++c) sum += !(vectors(i, c) - vectors(i, c) == 0.0);
      },
      n_faulty);
  return n_faulty == 0;
}

#define SKEIN_INSTANTIATE(S)                                                  \
  template BlobRange find_blob_range<S>(const S&, const ConstScalarView<S>&); \
  template bool are_finite<S>(const S&, const ConstVectorView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
