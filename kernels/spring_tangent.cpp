#include "kernels/spring_tangent.hpp"

#include <skein/core/error.hpp>

namespace skein {
namespace {

template <class Space>
KOKKOS_INLINE_FUNCTION Vec3 change_on_node(const SpringArrays<Space>& springs, const ConstVectorView<Space>& position,
                                           const ConstVectorView<Space>& displacement, const int node) {
  const FiberSprings fiber = springs.fiber(springs.fiber_of_node(node));
  const double* stiffnesses = springs.stiffness.data() + fiber.first_entry;
  const double* inverse_rest_lengths = springs.inverse_rest_length.data() + fiber.first_entry;
  const int n = fiber.nodes_per_section;
  const int section = (node - fiber.first_node) / n;
  const int a = (node - fiber.first_node) % n;
  const Vec3 x = load(position, node), u = load(displacement, node);
  const int first = math::larger(0, section - fiber.reach);
  const int last = math::smaller(fiber.n_sections - 1, section + fiber.reach);

  Vec3 change;
  for (int other_section = first; other_section <= last; ++other_section) {
    // Springs are listed from the earlier section to the later one.
    const int sense = other_section < section ? -1 : 1;
    const int row = sense * (other_section - section) * n;
    const int first_other = fiber.first_node + other_section * n;
    const double factor = spring_factor<Space>(springs, fiber, section, other_section);
    for (int b = 0; b < n; ++b) {
      const int steps = sense * (b - a);
      const int entry = row + (steps < 0 ? steps + n : steps);
      const double stiffness = factor * stiffnesses[entry];
      const Vec3 d = x - load(position, first_other + b);
      const double r_squared = dot(d, d);
      if (stiffness == 0.0 || r_squared == 0.0) continue;
      const double inverse_r = math::inverse_sqrt(r_squared);
      const Vec3 v = u - load(displacement, first_other + b);
      change = change + stiffness * (inverse_r - inverse_rest_lengths[entry]) * v;
      change = change - stiffness * inverse_r * inverse_r * inverse_r * dot(d, v) * d;
    }
  }
  return change;
}

}  // namespace

template <class Space>
void compute_spring_force_change(const Space& space, const SpringArrays<Space>& springs,
                                 const ConstVectorView<Space>& position, const ConstVectorView<Space>& displacement,
                                 const VectorView<Space>& change) {
  SKEIN_REQUIRE(position.extent(0) == springs.fiber_of_node.extent(0) && displacement.extent(0) == position.extent(0) &&
                    change.extent(0) == position.extent(0),
                "positions, displacements, changes and the nodes of the springs differ in number");
  Kokkos::parallel_for(
      "skein::compute_spring_force_change", Kokkos::RangePolicy<Space>(space, 0, position.extent_int(0)),
      KOKKOS_LAMBDA(const int node) {
        store(change, node, change_on_node<Space>(springs, position, displacement, node));
      });
}

#define SKEIN_INSTANTIATE(S)                                                                                \
  template void compute_spring_force_change<S>(const S&, const SpringArrays<S>&, const ConstVectorView<S>&, \
                                               const ConstVectorView<S>&, const VectorView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
