#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/section_boxes.hpp"

#include <limits>

namespace skein {

/// What is found where there is none.
inline constexpr int no_node = std::numeric_limits<int>::max();

/// Launches a search for the smallest index of a node that is not finite, or farther from its section's centroid than
/// max_ratio times the radius of its fiber. One launch over the sections of all fibers; does not wait for the device.
/// @param position  [n_nodes, 3], length
/// @param found     is there after the next wait for the device
template <class Space>
void seek_faulty_node(const Space& space, const SectionBoxes<Space>& boxes, const ConstVectorView<Space>& position,
                      double max_ratio, const FoundNumber& found);

}  // namespace skein
