#include "kernels/section_centroid.hpp"

namespace skein {

template <class Space>
void compute_section_centroids(const Space& space, const ConstVectorView<Space>& position, const SectionRun& run,
                               const int first_section, const VectorView<Space>& centroid) {
  Kokkos::parallel_for(
      "skein::compute_section_centroids", Kokkos::RangePolicy<Space>(space, 0, run.n_sections),
      KOKKOS_LAMBDA(const int section) {
        store(centroid, first_section + section,
              mean_of_rows<Space>(position, run.first_node + section * run.nodes_per_section, run.nodes_per_section));
      });
}

#define SKEIN_INSTANTIATE(S)                                                                              \
  template void compute_section_centroids<S>(const S&, const ConstVectorView<S>&, const SectionRun&, int, \
                                             const VectorView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
