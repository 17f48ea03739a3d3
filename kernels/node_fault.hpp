#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/section_run.hpp"

namespace skein {

/// The smallest index of a node that is not finite, or farther from its section's centroid than max_ratio times the
/// radius; -1 where there is none. One pass; waits for the device.
template <class Space>
int find_faulty_node(const Space& space, const ConstVectorView<Space>& position, const SectionRun& run,
                     double max_ratio);

}  // namespace skein
