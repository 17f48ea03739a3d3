#include "kernels/tube_surface.hpp"

#include <skein/arrays/launch.hpp>

namespace skein {

template <class Space>
void locate_surfaces(const Space& space, const TubeSurfaces<Space>& surfaces) {
  const TubeSurfaces<Space> s = surfaces;
  launch<Space>(
      "skein::enclose_rings", space, section_calls<Space>(surfaces.sections), KOKKOS_LAMBDA(const int item) {
        const int block = item / sections_per_block;
        const FiberSections& fiber = s.sections.fiber(s.sections.fiber_of_block(block));
        const int section = fiber.first_section_of(block) + item % sections_per_block;
        if (section >= fiber.end_section_of(block)) return;
        const int first = fiber.first_node_of(section), end = first + fiber.nodes_per_section;
        Vec3 low = load(s.position, first), high = low;
        for (int node = first + 1; node < end; ++node) {
          const Vec3 x = load(s.position, node);
          low = lower_of(low, x);
          high = upper_of(high, x);
        }
        store(s.ring_low, section, low);
        store(s.ring_high, section, high);
        store(s.sections.centroid, section, mean_of_rows<Space>(s.position, first, fiber.nodes_per_section));
      });
  launch<Space>(
      "skein::enclose_prisms", space, Calls{surfaces.sections.fiber_of_block.extent_int(0), 100.0},
      KOKKOS_LAMBDA(const int block) {
        const FiberSections& fiber = s.sections.fiber(s.sections.fiber_of_block(block));
        const int first = fiber.first_section_of(block);
        // The last prism ends at a ring of the next block, where there is one.
        const int end = math::larger(end_prism_of(fiber, block), first) + 1;
        Vec3 low, high;
        enclose<Space>(s.ring_low, s.ring_high, first, end, low, high);
        store(s.block_low, block, low);
        store(s.block_high, block, high);
        enclose_centroids<Space>(s.sections, block);
      });
  launch<Space>(
      "skein::enclose_tubes", space, Calls{surfaces.sections.fiber.extent_int(0), 100.0}, KOKKOS_LAMBDA(const int f) {
        const FiberSections& fiber = s.sections.fiber(f);
        Vec3 low, high;
        enclose<Space>(s.block_low, s.block_high, fiber.first_block, fiber.end_block(), low, high);
        store(s.fiber_low, f, low);
        store(s.fiber_high, f, high);
        enclose_blocks<Space>(s.sections, f);
      });
}

#define SKEIN_INSTANTIATE(S) template void locate_surfaces<S>(const S&, const TubeSurfaces<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
