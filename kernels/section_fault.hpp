#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/section_boxes.hpp"

namespace skein {

/// The smallest index of a node that is not finite, or farther from its section's centroid than max_ratio times the
/// radius of its fiber; -1 where there is none. One launch over the sections of all fibers; waits for the device.
/// @param position  [n_nodes, 3], length
template <class Space>
int find_faulty_node(const Space& space, const SectionBoxes<Space>& boxes, const ConstVectorView<Space>& position,
                     double max_ratio);

}  // namespace skein
