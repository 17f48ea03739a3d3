#include "kernels/node_checks.hpp"

namespace skein {

template <class Space>
BlobRange find_blob_range(const Space& space, const ConstScalarView<Space>& blob) {
  const Kokkos::RangePolicy<Space> range(space, 0, blob.extent_int(0));
  BlobRange found{0.0, 0.0};
  Kokkos::parallel_reduce(
      "skein::find_smallest_blob", range,
      KOKKOS_LAMBDA(const int i, double& least) { least = blob(i) < least ? blob(i) : least; },
      Kokkos::Min<double>(found.smallest));
  Kokkos::parallel_reduce(
      "skein::find_largest_blob", range,
      KOKKOS_LAMBDA(const int i, double& most) { most = blob(i) > most ? blob(i) : most; },
      Kokkos::Max<double>(found.largest));
  return found;
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
