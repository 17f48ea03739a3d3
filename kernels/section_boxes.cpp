#include "kernels/section_boxes.hpp"

#include <skein/core/error.hpp>

#include "kernels/section_centroid.hpp"

namespace skein {
template <class Space>
void compute_section_means(const Space& space, const SectionBoxes<Space>& boxes, const ConstVectorView<Space>& vector,
                           const VectorView<Space>& mean) {
  SKEIN_REQUIRE(mean.extent(0) == boxes.centroid.extent(0), "one mean for each section is needed");
  const SectionBoxes<Space> b = boxes;
  Kokkos::parallel_for(
      "skein::compute_section_means", Kokkos::RangePolicy<Space>(space, 0, boxes.fiber_of_run.extent_int(0)),
      KOKKOS_LAMBDA(const int run) {
        const BoxedFiber& fiber = b.fiber(b.fiber_of_run(run));
        const int end = fiber.end_section_of(run);
        for (int section = fiber.first_section_of(run); section < end; ++section)
          store(mean, section, mean_of_rows<Space>(vector, fiber.first_node_of(section), fiber.nodes_per_section));
      });
}

template <class Space>
void locate_sections(const Space& space, const SectionBoxes<Space>& boxes, const ConstVectorView<Space>& position) {
  compute_section_means<Space>(space, boxes, position, boxes.centroid);
  const SectionBoxes<Space> b = boxes;
  Kokkos::parallel_for(
      "skein::enclose_runs", Kokkos::RangePolicy<Space>(space, 0, boxes.fiber_of_run.extent_int(0)),
      KOKKOS_LAMBDA(const int run) {
        const BoxedFiber& fiber = b.fiber(b.fiber_of_run(run));
        Vec3 low, high;
        enclose<Space>(b.centroid, b.centroid, fiber.first_section_of(run), fiber.end_section_of(run), low, high);
        store(b.run_low, run, low);
        store(b.run_high, run, high);
      });
  Kokkos::parallel_for(
      "skein::enclose_fibers", Kokkos::RangePolicy<Space>(space, 0, boxes.fiber.extent_int(0)),
      KOKKOS_LAMBDA(const int f) {
        Vec3 low, high;
        enclose<Space>(b.run_low, b.run_high, b.fiber(f).first_run, b.fiber(f).end_run(), low, high);
        store(b.fiber_low, f, low);
        store(b.fiber_high, f, high);
      });
}

#define SKEIN_INSTANTIATE(S)                                                                          \
  template void compute_section_means<S>(const S&, const SectionBoxes<S>&, const ConstVectorView<S>&, \
                                         const VectorView<S>&);                                       \
  template void locate_sections<S>(const S&, const SectionBoxes<S>&, const ConstVectorView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
