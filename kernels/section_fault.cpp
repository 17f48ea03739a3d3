#include "kernels/section_fault.hpp"

namespace skein {
namespace {

constexpr double largest_square = 1e300;  ///< of a distance that counts as finite, length^2

/// The first faulty node of a section, or no_node.
template <class Space>
KOKKOS_INLINE_FUNCTION int find_in_section(const ConstVectorView<Space>& position, const FiberSections& fiber,
                                           const int section, const double max_ratio) {
  const int first_node = fiber.first_node_of(section), n = fiber.nodes_per_section;
  const double max_distance_squared = max_ratio * max_ratio * fiber.radius * fiber.radius;
  Vec3 centroid;
  for (int a = 0; a < n; ++a) centroid = centroid + load(position, first_node + a);
  centroid = centroid / static_cast<double>(n);
  // One bad node makes the centroid bad, so that every node of the section would look faulty: name the first that is
  // bad by itself. Comparisons are written so that NaN fails them.
  for (int pass = 0; pass < 2; ++pass)
    for (int a = 0; a < n; ++a) {
      const Vec3 x = load(position, first_node + a);
      const Vec3 from_centre = x - centroid;
      const double size = pass == 0 ? dot(x, x) : dot(from_centre, from_centre);
      if (!(size <= (pass == 0 ? largest_square : max_distance_squared))) return first_node + a;
    }
  return no_node;
}

}  // namespace

template <class Space>
void seek_faulty_node(const Space& space, const SectionBoxes<Space>& boxes, const ConstVectorView<Space>& position,
                      const double max_ratio, const FoundNumber& found_node) {
  const SectionBoxes<Space> b = boxes;
  launch_reduction<Space>(
      "skein::seek_faulty_node", space, section_calls<Space>(boxes),
      KOKKOS_LAMBDA(const int item, int& smallest) {
        const int block = item / sections_per_block;
        const FiberSections& fiber = b.fiber(b.fiber_of_block(block));
        const int section = fiber.first_section_of(block) + item % sections_per_block;
        if (section >= fiber.end_section_of(block)) return;
        const int found = find_in_section<Space>(position, fiber, section, max_ratio);
        if (found < smallest) smallest = found;
      },
      Kokkos::Min<int, SharedHostMemory>(found_node));
}

#define SKEIN_INSTANTIATE(S)                                                                             \
  template void seek_faulty_node<S>(const S&, const SectionBoxes<S>&, const ConstVectorView<S>&, double, \
                                    const FoundNumber&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
