#pragma once

#include <skein/arrays/types.hpp>
#include <skein/core/simd.hpp>

#include "kernels/index_range.hpp"

namespace skein {

/// Where one fiber's nodes, sections and stencil lie in the arrays of all fibers.
struct FiberSprings {
  int first_node = 0;
  int first_section = 0;
  int first_tile = 0;   ///< see sections_per_tile
  int first_entry = 0;  ///< of its stencil in stiffness and inverse_rest_length
  int n_sections = 0;
  int nodes_per_section = 0;
  int reach = 0;  ///< springs join sections up to this far apart
};

/// The springs of all fibers. Stencil entry (o, d) of a fiber, at first_entry + o nodes_per_section + d, joins node a
/// of section s to node (a + d) mod nodes_per_section of section s + o; stiffness 0 means no spring.
template <class Space>
struct SpringArrays {
  Kokkos::View<FiberSprings*, Space> fiber;    // [n_fibers]
  Kokkos::View<int*, Space> fiber_of_node;     // [n_nodes]
  Kokkos::View<int*, Space> fiber_of_section;  // [n_sections]
  Kokkos::View<int*, Space> fiber_of_tile;     // [n_tiles]
  ScalarView<Space> stiffness;                 // [n_entries], force
  ScalarView<Space> inverse_rest_length;       // [n_entries], 1 / length
  ScalarView<Space> section_factor;            // [n_sections], of the stiffness; see spring_factor
  VectorView<Space> reaction;                  // [reach * n_nodes, 3], force; scratch of the tiles, zero at first
  bool has_wide_sections = false;              // more than max_tile_nodes nodes on a section
};

/// Of springs between two sections of a fiber, or inside one: springs are as stiff as the mean of their ends.
template <class Space>
KOKKOS_INLINE_FUNCTION double spring_factor(const SpringArrays<Space>& springs, const FiberSprings& fiber,
                                            const int section, const int other_section) {
  const int first = fiber.first_section;
  return 0.5 * (springs.section_factor(first + section) + springs.section_factor(first + other_section));
}

/// The host takes this many sections of a fiber at once, one in each lane.
inline constexpr int sections_per_tile = simd::width<double>;
inline constexpr int max_tile_nodes = 64;

/// Adds to force, [n_nodes, 3], the springs' force on each of some nodes:
///
///   force on a node = - sum over its springs of k (r/l - 1) d/r,   d = node - other node, r = |d|;   zero at r = 0
///
/// The order of every sum is fixed: the result depends neither on threads nor on which other nodes there are. Forces of
/// other nodes near these are left in any state.
template <class Space>
void add_spring_force(const Space& space, const SpringArrays<Space>& springs, IndexRange nodes,
                      const ConstVectorView<Space>& position, const VectorView<Space>& force);

/// The same by a few threads per node, each spring weighed at both of its nodes: the way of GPUs, and of the
/// host where sections have more nodes than a tile holds.
template <class Space>
void add_spring_force_by_nodes(const Space& space, const SpringArrays<Space>& springs, IndexRange nodes,
                               const ConstVectorView<Space>& position, const VectorView<Space>& force);

/// The same for all nodes, in place of what was in `force`.
template <class Space>
void compute_spring_force_by_nodes(const Space& space, const SpringArrays<Space>& springs,
                                   const ConstVectorView<Space>& position, const VectorView<Space>& force);

/// What springs are asked for beside their forces.
template <class Space>
struct SpringMeasures {
  FoundReals section_energy;  ///< [n_sections], sum k l (r/l - 1)^2 / 2 over the springs inside each and to later ones
  FoundReal largest_strain;   ///< |r/l - 1| of any spring, r its length and l that at rest; below 0 without springs
  ScalarView<Space> node_energy;  ///< [n_nodes], scratch
};

/// Launches the search for them; they are there after the next wait for the device. Each sum has a fixed order.
template <class Space>
void seek_spring_measures(const Space& space, const SpringArrays<Space>& springs,
                          const ConstVectorView<Space>& position, const SpringMeasures<Space>& measures);

}  // namespace skein
