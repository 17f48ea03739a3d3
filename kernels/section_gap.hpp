#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/section_boxes.hpp"

namespace skein {

/// Launches a search for the smallest distance between the surfaces of sections of two fibers, or of distant sections
/// of one (see Fiber::distant_sections), taken as spheres about their centroids; negative where they overlap. Length.
/// It sees the sections where locate_sections left them; does not wait for the device.
template <class Space>
void seek_smallest_gap(const Space& space, const SectionBoxes<Space>& boxes, const FoundReal& gap);

/// What was found, after a wait for the device; infinite where there is no such pair.
double found_gap(const FoundReal& gap);

}  // namespace skein
