#include "kernels/node_fault.hpp"

#include <limits>

namespace skein {

template <class Space>
int find_faulty_node(const Space& space, const ConstVectorView<Space>& position, const SectionRun& run,
                     const double max_ratio) {
  constexpr int none = std::numeric_limits<int>::max();
  const double max_distance_squared = max_ratio * max_ratio * run.radius * run.radius;
  int first = none;
  Kokkos::parallel_reduce(
      "skein::find_faulty_node", Kokkos::RangePolicy<Space>(space, 0, run.n_sections),
      KOKKOS_LAMBDA(const int section, int& smallest) {
        const int first_node = run.first_node + section * run.nodes_per_section;
        Vec3 centroid;
        for (int a = 0; a < run.nodes_per_section; ++a) centroid = centroid + load(position, first_node + a);
        centroid = centroid / static_cast<double>(run.nodes_per_section);
        // One bad node makes the centroid bad, so that every node of the section would look faulty: name the first that
        // is bad by itself. Comparisons are written so that NaN fails them.
        for (int pass = 0; pass < 2; ++pass)
          for (int a = 0; a < run.nodes_per_section; ++a) {
            const Vec3 x = load(position, first_node + a);
            const Vec3 from_centre = x - centroid;
            const double size = pass == 0 ? dot(x, x) : dot(from_centre, from_centre);
            const double limit = pass == 0 ? 1e300 : max_distance_squared;
            if (!(size <= limit)) {
              if (first_node + a < smallest) smallest = first_node + a;
              return;
            }
          }
      },
      Kokkos::Min<int>(first));
  return first == none ? -1 : first;
}

#define SKEIN_INSTANTIATE(S) \
  template int find_faulty_node<S>(const S&, const ConstVectorView<S>&, const SectionRun&, double);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
