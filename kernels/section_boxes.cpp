#include "kernels/section_boxes.hpp"

#include <skein/arrays/launch.hpp>
#include <skein/core/error.hpp>

namespace skein {

template <class Space>
void compute_section_means(const Space& space, const SectionBoxes<Space>& boxes, const IndexRange blocks,
                           const ConstVectorView<Space>& vector, const VectorView<Space>& mean) {
  SKEIN_REQUIRE(mean.extent(0) == boxes.centroid.extent(0), "one mean for each section is needed");
  const SectionBoxes<Space> b = boxes;
  launch<Space>(
      "skein::compute_section_means", space, section_calls(blocks), KOKKOS_LAMBDA(const int item) {
        const int block = blocks.first + item / sections_per_block;
        const FiberSections& fiber = b.fiber(b.fiber_of_block(block));
        const int section = fiber.first_section_of(block) + item % sections_per_block;
        if (section >= fiber.end_section_of(block)) return;
        store(mean, section, mean_of_rows<Space>(vector, fiber.first_node_of(section), fiber.nodes_per_section));
      });
}

template <class Space>
void enclose_sections(const Space& space, const SectionBoxes<Space>& boxes) {
  const SectionBoxes<Space> b = boxes;
  launch<Space>(
      "skein::enclose_blocks", space, Calls{boxes.fiber_of_block.extent_int(0), 50.0},
      KOKKOS_LAMBDA(const int block) { enclose_centroids<Space>(b, block); });
  launch<Space>(
      "skein::enclose_fibers", space, Calls{boxes.fiber.extent_int(0), 50.0},
      KOKKOS_LAMBDA(const int f) { enclose_blocks<Space>(b, f); });
}

template <class Space>
void locate_sections(const Space& space, const SectionBoxes<Space>& boxes, const ConstVectorView<Space>& position) {
  compute_section_means<Space>(space, boxes, all_blocks<Space>(boxes), position, boxes.centroid);
  enclose_sections<Space>(space, boxes);
}

#define SKEIN_INSTANTIATE(S)                                                                                      \
  template void enclose_sections<S>(const S&, const SectionBoxes<S>&);                                            \
  template void compute_section_means<S>(const S&, const SectionBoxes<S>&, IndexRange, const ConstVectorView<S>&, \
                                         const VectorView<S>&);                                                   \
  template void locate_sections<S>(const S&, const SectionBoxes<S>&, const ConstVectorView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
