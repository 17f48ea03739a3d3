#pragma once

#include <skein/arrays/launch.hpp>
#include <skein/arrays/types.hpp>

#include "kernels/index_range.hpp"

namespace skein {

/// Sections of a fiber that share a box: a block of them.
inline constexpr int sections_per_block = 16;

/// Where one fiber's nodes, sections and blocks lie in the arrays of all fibers.
struct FiberSections {
  int first_node = 0;
  int first_section = 0;
  int first_block = 0;
  int n_sections = 0;
  int nodes_per_section = 0;
  int distant_sections = 0;  ///< see Fiber::distant_sections
  double radius = 0.0;       ///< length
  double spacing = 0.0;      ///< of sections, length

  /// Of all fibers' blocks and sections, as all below.
  KOKKOS_INLINE_FUNCTION int end_block() const { return first_block + math::ceil_div(n_sections, sections_per_block); }
  KOKKOS_INLINE_FUNCTION int first_section_of(const int block) const {
    return first_section + (block - first_block) * sections_per_block;
  }
  KOKKOS_INLINE_FUNCTION int end_section_of(const int block) const {
    return math::smaller(first_section_of(block) + sections_per_block, first_section + n_sections);
  }
  KOKKOS_INLINE_FUNCTION int first_node_of(const int section) const {
    return first_node + (section - first_section) * nodes_per_section;
  }
};

/// Centroids of all sections, with boxes about short blocks of them and about fibers, so that a search passes over what
/// is far away.
template <class Space>
struct SectionBoxes {
  Kokkos::View<FiberSections*, Space> fiber;
  Kokkos::View<int*, Space> fiber_of_block;
  VectorView<Space> centroid;               ///< [n_sections, 3], length
  VectorView<Space> block_low, block_high;  ///< [n_blocks, 3], length
  VectorView<Space> fiber_low, fiber_high;  ///< [n_fibers, 3], length
};

template <class Space>
IndexRange all_blocks(const SectionBoxes<Space>& boxes) {
  return {0, boxes.fiber_of_block.extent_int(0)};
}

/// A loop over the places of blocks, some of which are behind their fiber's last section.
inline Calls section_calls(const IndexRange blocks) { return {blocks.count * sections_per_block, 30.0}; }
template <class Space>
Calls section_calls(const SectionBoxes<Space>& boxes) {
  return section_calls(all_blocks<Space>(boxes));
}

/// Overwrites mean, [n_sections, 3], with the mean over each section's nodes of a vector on nodes, [n_nodes, 3]: of the
/// sections of some blocks.
template <class Space>
void compute_section_means(const Space& space, const SectionBoxes<Space>& boxes, IndexRange blocks,
                           const ConstVectorView<Space>& vector, const VectorView<Space>& mean);

/// Overwrites boxes with those of the centroids.
template <class Space>
void enclose_sections(const Space& space, const SectionBoxes<Space>& boxes);

/// Overwrites centroids and boxes with those of nodes at `position`, [n_nodes, 3].
template <class Space>
void locate_sections(const Space& space, const SectionBoxes<Space>& boxes, const ConstVectorView<Space>& position);

KOKKOS_INLINE_FUNCTION Vec3 lower_of(const Vec3 a, const Vec3 b) {
  return {a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z};
}
KOKKOS_INLINE_FUNCTION Vec3 upper_of(const Vec3 a, const Vec3 b) {
  return {a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z};
}

/// Low and high corner of the box about rows [first, end) of corners.
template <class Space>
KOKKOS_INLINE_FUNCTION void enclose(const VectorView<Space>& lows, const VectorView<Space>& highs, const int first,
                                    const int end, Vec3& low, Vec3& high) {
  low = load(lows, first);
  high = load(highs, first);
  for (int i = first + 1; i < end; ++i) {
    low = lower_of(low, load(lows, i));
    high = upper_of(high, load(highs, i));
  }
}

/// Mean of the rows [first, first + count) of a vector, such as a section's nodes.
template <class Space>
KOKKOS_INLINE_FUNCTION Vec3 mean_of_rows(const ConstVectorView<Space>& vector, const int first, const int count) {
  Vec3 sum;
  for (int row = first; row < first + count; ++row) sum = sum + load(vector, row);
  return sum / static_cast<double>(count);
}

/// Encloses the centroids of a block, and the blocks of a fiber.
template <class Space>
KOKKOS_INLINE_FUNCTION void enclose_centroids(const SectionBoxes<Space>& boxes, const int block) {
  const FiberSections& fiber = boxes.fiber(boxes.fiber_of_block(block));
  Vec3 low, high;
  enclose<Space>(boxes.centroid, boxes.centroid, fiber.first_section_of(block), fiber.end_section_of(block), low, high);
  store(boxes.block_low, block, low);
  store(boxes.block_high, block, high);
}
template <class Space>
KOKKOS_INLINE_FUNCTION void enclose_blocks(const SectionBoxes<Space>& boxes, const int f) {
  Vec3 low, high;
  enclose<Space>(boxes.block_low, boxes.block_high, boxes.fiber(f).first_block, boxes.fiber(f).end_block(), low, high);
  store(boxes.fiber_low, f, low);
  store(boxes.fiber_high, f, high);
}

/// Square of the distance between two boxes, 0 where they overlap. No less than rounding below that of two points in
/// them.
KOKKOS_INLINE_FUNCTION double squared_distance(const Vec3 low, const Vec3 high, const Vec3 other_low,
                                               const Vec3 other_high) {
  const auto between = [](const double a_low, const double a_high, const double b_low, const double b_high) {
    const double above = b_low - a_high, below = a_low - b_high;
    const double gap = above > below ? above : below;
    return gap > 0.0 ? gap : 0.0;
  };
  const Vec3 d{between(low.x, high.x, other_low.x, other_high.x), between(low.y, high.y, other_low.y, other_high.y),
               between(low.z, high.z, other_low.z, other_high.z)};
  return dot(d, d);
}

/// Calls body(fiber, block) for each block, in order, that has points within range + margin + the radius of its fiber
/// of the box from low to high.
template <class Space, class Body>
KOKKOS_INLINE_FUNCTION void for_each_near_block(const SectionBoxes<Space>& boxes, const Vec3 low, const Vec3 high,
                                                const double margin, const Body& body) {
  const int n_fibers = boxes.fiber.extent_int(0);
  for (int f = 0; f < n_fibers; ++f) {
    const FiberSections& fiber = boxes.fiber(f);
    const double reach = margin + fiber.radius;
    const double limit = reach * reach;
    if (squared_distance(low, high, load(boxes.fiber_low, f), load(boxes.fiber_high, f)) > limit) continue;
    const int end = fiber.end_block();
    for (int block = fiber.first_block; block < end; ++block)
      if (squared_distance(low, high, load(boxes.block_low, block), load(boxes.block_high, block)) <= limit)
        body(f, block);
  }
}

}  // namespace skein
