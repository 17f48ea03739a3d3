#pragma once

#include <skein/core/types.hpp>

#include "kernels/section_run.hpp"

namespace skein {

/// centroid [first_section + s] = mean of the nodes of section s of the run; [n_sections of all fibers, 3], length.
template <class Space>
void compute_section_centroids(const Space& space, const ConstVectorView<Space>& position, const SectionRun& run,
                               int first_section, const VectorView<Space>& centroid);

}  // namespace skein
