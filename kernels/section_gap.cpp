#include "kernels/section_gap.hpp"

#include <skein/arrays/launch.hpp>

#include <limits>

namespace skein {
namespace {

constexpr double rounding = 1.0 + 1e-12;  ///< keeps what rounding alone makes as large from being passed over
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Smallest gaps of one block of sections, on devices of one section of it: with every block that comes after, and
/// inside. Blocks that cannot be nearer than the smallest gap so far are passed over, so that sums of few distances are
/// taken where fibers are far apart. A minimum does not depend on the order in which it is taken.
template <class Space>
struct BlockGap {
  static constexpr int items_per_block = on_host<Space> ? 1 : sections_per_block;
  SectionBoxes<Space> boxes;

  KOKKOS_INLINE_FUNCTION void operator()(const int item, double& smallest) const {
    const int block = item / items_per_block;
    const int f = boxes.fiber_of_block(block), n_fibers = boxes.fiber.extent_int(0);
    int section = boxes.fiber(f).first_section_of(block), end = boxes.fiber(f).end_section_of(block);
    if constexpr (items_per_block > 1) {
      section += item % items_per_block;
      if (section >= end) return;
      end = section + 1;
    }
    for (int other_f = f; other_f < n_fibers; ++other_f) {
      const double radii = boxes.fiber(f).radius + boxes.fiber(other_f).radius;
      if (is_beyond(smallest + radii, block, boxes.fiber_low, boxes.fiber_high, other_f)) continue;
      const int first = other_f == f ? block : boxes.fiber(other_f).first_block;
      for (int other = first; other < boxes.fiber(other_f).end_block(); ++other)
        if (!is_beyond(smallest + radii, block, boxes.block_low, boxes.block_high, other))
          take_smaller(f, section, end, other_f, other, smallest);
    }
  }

  /// True where a box is farther from the block's than `distance`.
  KOKKOS_INLINE_FUNCTION bool is_beyond(const double distance, const int block, const VectorView<Space>& low,
                                        const VectorView<Space>& high, const int box) const {
    return distance < 0.0 || squared_distance(load(boxes.block_low, block), load(boxes.block_high, block),
                                              load(low, box), load(high, box)) > rounding * distance * distance;
  }

  /// Of sections [first, end) of a fiber with those of another block.
  KOKKOS_INLINE_FUNCTION void take_smaller(const int f, const int first, const int end, const int other_f,
                                           const int other_block, double& smallest) const {
    const FiberSections &fiber = boxes.fiber(f), &other_fiber = boxes.fiber(other_f);
    double nearest = infinity;
    const int other_end = other_fiber.end_section_of(other_block);
    for (int section = first; section < end; ++section) {
      const Vec3 x = load(boxes.centroid, section);
      int other = other_fiber.first_section_of(other_block);
      if (f == other_f) other = math::larger(other, section + fiber.distant_sections);
      for (; other < other_end; ++other) {
        const Vec3 d = x - load(boxes.centroid, other);
        const double square = dot(d, d);
        if (square < nearest) nearest = square;
      }
    }
    const double gap = nearest < infinity ? math::sqrt(nearest) - (fiber.radius + other_fiber.radius) : infinity;
    if (gap < smallest) smallest = gap;
  }
};

}  // namespace

template <class Space>
void seek_smallest_gap(const Space& space, const SectionBoxes<Space>& boxes, const FoundReal& gap) {
  launch_reduction<Space>(
      "skein::seek_smallest_gap", space,
      Calls{boxes.fiber_of_block.extent_int(0) * BlockGap<Space>::items_per_block, 16.0 * boxes.centroid.extent_int(0)},
      BlockGap<Space>{boxes}, Kokkos::Min<double, SharedHostMemory>(gap));
}

double found_gap(const FoundReal& gap) {
  return gap() < std::numeric_limits<double>::max() ? gap() : infinity;  // the reduction begins with the latter
}

#define SKEIN_INSTANTIATE(S) template void seek_smallest_gap<S>(const S&, const SectionBoxes<S>&, const FoundReal&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
