#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/section_run.hpp"

namespace skein {

/// Mean of the rows [first, first + count) of a vector, such as a section's nodes.
template <class Space>
KOKKOS_INLINE_FUNCTION Vec3 mean_of_rows(const ConstVectorView<Space>& vector, const int first, const int count) {
  Vec3 sum;
  for (int row = first; row < first + count; ++row) sum = sum + load(vector, row);
  return sum / static_cast<double>(count);
}

/// centroid [first_section + s] = mean of the nodes of section s of the run; [n_sections of all fibers, 3], length.
template <class Space>
void compute_section_centroids(const Space& space, const ConstVectorView<Space>& position, const SectionRun& run,
                               int first_section, const VectorView<Space>& centroid);

}  // namespace skein
