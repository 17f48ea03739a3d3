#include "kernels/section_boxes.hpp"

#include <skein/core/error.hpp>

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
        const int first = (run - fiber.first_run) * sections_per_run;
        const int end = math::smaller(first + sections_per_run, fiber.n_sections);
        const int n = fiber.nodes_per_section;
        for (int section = first; section < end; ++section) {
          Vec3 sum;
          for (int a = 0; a < n; ++a) sum = sum + load(vector, fiber.first_node + section * n + a);
          store(mean, fiber.first_section + section, sum / static_cast<double>(n));
        }
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
        const int first = (run - fiber.first_run) * sections_per_run;
        const int end = math::smaller(first + sections_per_run, fiber.n_sections);
        Vec3 low, high;
        enclose<Space>(b.centroid, b.centroid, fiber.first_section + first, fiber.first_section + end, low, high);
        store(b.run_low, run, low);
        store(b.run_high, run, high);
      });
  Kokkos::parallel_for(
      "skein::enclose_fibers", Kokkos::RangePolicy<Space>(space, 0, boxes.fiber.extent_int(0)),
      KOKKOS_LAMBDA(const int f) {
        const int first = b.fiber(f).first_run;
        Vec3 low, high;
        enclose<Space>(b.run_low, b.run_high, first, first + math::ceil_div(b.fiber(f).n_sections, sections_per_run),
                       low, high);
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
