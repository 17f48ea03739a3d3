#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/section_boxes.hpp"

namespace skein {

/// The smallest distance between the surfaces of sections of two fibers, or of distant sections of one (see
/// Fiber::distant_sections), taken as spheres about their centroids; negative where they overlap, infinite where there
/// is no such pair. Length. It sees the sections where locate_sections left them; waits for the device.
template <class Space>
double compute_smallest_gap(const Space& space, const SectionBoxes<Space>& boxes);

}  // namespace skein
