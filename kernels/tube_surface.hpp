#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/section_boxes.hpp"

namespace skein {

/// The surfaces of fibers. The nodes of a section are a ring; two neighbouring rings bound a prism, whose sides are
/// quadrilaterals, cut into two triangles each; fans about the centroids close the first and the last ring. Rings may
/// have any shape: nothing is assumed about how fibers are deformed. A prism has the number of its first section.
template <class Space>
struct TubeSurfaces {
  SectionBoxes<Space> sections;             ///< located, too
  ConstVectorView<Space> position;          ///< [n_nodes, 3], length
  VectorView<Space> ring_low, ring_high;    ///< [n_sections, 3], boxes about rings, length
  VectorView<Space> block_low, block_high;  ///< [n_blocks, 3], boxes about all prisms that begin in a block, length
  VectorView<Space> fiber_low, fiber_high;  ///< [n_fibers, 3], length
};

/// Prisms [begin, end) that a point does not see.
struct HiddenPrisms {
  int begin = 0, end = 0;

  KOKKOS_INLINE_FUNCTION bool hides(const int prism) const { return prism >= begin && prism < end; }
  /// Of all prisms [first, last).
  KOKKOS_INLINE_FUNCTION bool hides_all(const int first, const int last) const { return first >= begin && last <= end; }
};

/// Overwrites centroids and boxes with those of the nodes at `position`, those of the sections, too.
template <class Space>
void locate_surfaces(const Space& space, const TubeSurfaces<Space>& surfaces);

/// The first prism behind those that begin in a block; a fiber has one less than sections.
KOKKOS_INLINE_FUNCTION int end_prism_of(const FiberSections& fiber, const int block) {
  return math::smaller(fiber.end_section_of(block), fiber.first_section + fiber.n_sections - 1);
}

/// Square of the distance between the box about a prism and another one, 0 where they overlap.
template <class Space>
KOKKOS_INLINE_FUNCTION double squared_distance_to_prism(const TubeSurfaces<Space>& surfaces, const int prism,
                                                        const Vec3 low, const Vec3 high) {
  return squared_distance(low, high, lower_of(load(surfaces.ring_low, prism), load(surfaces.ring_low, prism + 1)),
                          upper_of(load(surfaces.ring_high, prism), load(surfaces.ring_high, prism + 1)));
}

}  // namespace skein
