#pragma once

#include "kernels/spring_force.hpp"

namespace skein {

/// Calls body(other node, stiffness, 1 / rest length) for each spring of a node, in a fixed order.
/// @param share, n_shares  of each section's nodes every n_shares-th, from `share` on
template <class Space, class Body>
KOKKOS_INLINE_FUNCTION void for_each_spring(const SpringArrays<Space>& springs, const int node, const Body& body,
                                            const int share = 0, const int n_shares = 1) {
  const FiberSprings fiber = springs.fiber(springs.fiber_of_node(node));
  const double* stiffness = springs.stiffness.data() + fiber.first_entry;
  const double* inverse_rest_length = springs.inverse_rest_length.data() + fiber.first_entry;
  const int n = fiber.nodes_per_section;
  const int section = (node - fiber.first_node) / n;
  const int a = (node - fiber.first_node) % n;
  const int first = math::larger(0, section - fiber.reach);
  const int last = math::smaller(fiber.n_sections - 1, section + fiber.reach);
  for (int other_section = first; other_section <= last; ++other_section) {
    // Springs are listed from the earlier section to the later one.
    const int sense = other_section < section ? -1 : 1;
    const int row = sense * (other_section - section) * n;
    const int first_other = fiber.first_node + other_section * n;
    const double factor = spring_factor<Space>(springs, fiber, section, other_section);
    for (int b = share; b < n; b += n_shares) {
      const int steps = sense * (b - a);
      const int entry = row + (steps < 0 ? steps + n : steps);
      if (stiffness[entry] != 0.0) body(first_other + b, factor * stiffness[entry], inverse_rest_length[entry]);
    }
  }
}

}  // namespace skein
