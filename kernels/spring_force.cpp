#include "kernels/spring_force.hpp"

#include <skein/arrays/launch.hpp>
#include <skein/core/error.hpp>

#include "kernels/spring_teams.hpp"
#include "kernels/spring_tiles.hpp"

namespace skein {
namespace {

/// Stencil of one fiber as a kernel reads it.
struct StencilPointers {
  const double* stiffness;
  const double* inverse_rest_length;
};

template <class Space>
KOKKOS_INLINE_FUNCTION StencilPointers stencil_of(const SpringArrays<Space>& springs, const FiberSprings& fiber) {
  return {springs.stiffness.data() + fiber.first_entry, springs.inverse_rest_length.data() + fiber.first_entry};
}

/// Energy of the springs from a node to later ones; widens the largest strain by theirs.
template <class Space>
KOKKOS_INLINE_FUNCTION double energy_from_node(const SpringArrays<Space>& springs,
                                               const ConstVectorView<Space>& position, const int node,
                                               double& largest_strain) {
  const FiberSprings fiber = springs.fiber(springs.fiber_of_node(node));
  const StencilPointers stencil = stencil_of(springs, fiber);
  const int n = fiber.nodes_per_section;
  const int section = (node - fiber.first_node) / n, a = (node - fiber.first_node) % n;
  const int last_offset = math::smaller(fiber.reach, fiber.n_sections - 1 - section);
  const Vec3 x = load(position, node);
  double energy = 0.0;
  for (int offset = 0; offset <= last_offset; ++offset) {
    const double factor = spring_factor<Space>(springs, fiber, section, section + offset);
    for (int b = offset == 0 ? a + 1 : 0; b < n; ++b) {
      const int entry = offset * n + (b >= a ? b - a : b - a + n);
      const double stiffness = stencil.stiffness[entry];
      if (stiffness == 0.0) continue;
      const double inverse_rest_length = stencil.inverse_rest_length[entry];
      const double strain = norm(x - load(position, node - a + offset * n + b)) * inverse_rest_length - 1.0;
      energy += 0.5 * factor * stiffness / inverse_rest_length * strain * strain;
      const double size = strain < 0.0 ? -strain : strain;
      if (size > largest_strain) largest_strain = size;
    }
  }
  return energy;
}

template <class Space>
void check_extents(const SpringArrays<Space>& springs, const ConstVectorView<Space>& position,
                   const VectorView<Space>& force) {
  SKEIN_REQUIRE(position.extent(0) == springs.fiber_of_node.extent(0) && force.extent(0) == position.extent(0),
                "positions, forces and the nodes of the springs differ in number");
}

template <class Space>
void sum_by_teams(const Space& space, const SpringArrays<Space>& springs, const IndexRange nodes,
                  const ConstVectorView<Space>& position, const VectorView<Space>& force, const bool adds) {
  using Sum = ForcesByTeams<Space>;
  check_extents<Space>(springs, position, force);
  if (nodes.count == 0) return;
  typename Sum::Policy policy(space, math::ceil_div(nodes.count, Sum::team_nodes), on_host<Space> ? 1 : Sum::n_workers);
  policy.set_scratch_size(0, Kokkos::PerTeam(static_cast<int>(Sum::Partial::shmem_size(Sum::n_workers))));
  Kokkos::parallel_for("skein::add_spring_force_by_nodes",
                       Kokkos::Experimental::require(policy, Kokkos::Experimental::WorkItemProperty::HintLightWeight),
                       Sum{springs, position, force, nodes, adds});
}

/// A node to a thread of a host.
void add_by_nodes_of_host(const HostSpace& space, const SpringArrays<HostSpace>& springs, const IndexRange nodes,
                          const ConstVectorView<HostSpace>& position, const VectorView<HostSpace>& force) {
  check_extents<HostSpace>(springs, position, force);
  launch<HostSpace>("skein::add_spring_force_by_nodes", space, Calls{nodes.count, 100.0}, [=](const int i) {
    const int node = nodes.first + i;
    store(force, node, load(force, node) + force_on_node<HostSpace>(springs, position, node));
  });
}

}  // namespace

template <class Space>
void add_spring_force_by_nodes(const Space& space, const SpringArrays<Space>& springs, const IndexRange nodes,
                               const ConstVectorView<Space>& position, const VectorView<Space>& force) {
  sum_by_teams<Space>(space, springs, nodes, position, force, true);
}

template <class Space>
void compute_spring_force_by_nodes(const Space& space, const SpringArrays<Space>& springs,
                                   const ConstVectorView<Space>& position, const VectorView<Space>& force) {
  sum_by_teams<Space>(space, springs, {0, position.extent_int(0)}, position, force, false);
}

template <class Space>
void add_spring_force(const Space& space, const SpringArrays<Space>& springs, const IndexRange nodes,
                      const ConstVectorView<Space>& position, const VectorView<Space>& force) {
  if (nodes.count == 0) return;
  if constexpr (!on_host<Space>) {
    add_spring_force_by_nodes<Space>(space, springs, nodes, position, force);
  } else if (springs.has_wide_sections) {
    add_by_nodes_of_host(space, springs, nodes, position, force);
  } else {
    check_extents<Space>(springs, position, force);
    add_spring_force_by_tiles(space, springs, nodes, position, force);
  }
}

template <class Space>
void seek_spring_measures(const Space& space, const SpringArrays<Space>& springs,
                          const ConstVectorView<Space>& position, const SpringMeasures<Space>& measures) {
  SKEIN_REQUIRE(position.extent(0) == springs.fiber_of_node.extent(0),
                "positions and nodes of the springs differ in number");
  SKEIN_REQUIRE(measures.node_energy.extent(0) == position.extent(0) &&
                    measures.section_energy.extent(0) == springs.fiber_of_section.extent(0),
                "one energy for each node and for each section is needed");
  const SpringMeasures<Space> to = measures;
  launch_reduction<Space>(
      "skein::compute_node_energy", space, Calls{position.extent_int(0), 100.0},
      KOKKOS_LAMBDA(const int node, double& largest_strain) {
        to.node_energy(node) = energy_from_node<Space>(springs, position, node, largest_strain);
      },
      Kokkos::Max<double, SharedHostMemory>(measures.largest_strain));
  launch<Space>(
      "skein::compute_section_energy", space, Calls{measures.section_energy.extent_int(0), 10.0},
      KOKKOS_LAMBDA(const int global_section) {
        const FiberSprings fiber = springs.fiber(springs.fiber_of_section(global_section));
        const int n = fiber.nodes_per_section, first = fiber.first_node + (global_section - fiber.first_section) * n;
        double energy = 0.0;
        for (int node = first; node < first + n; ++node) energy += to.node_energy(node);
        to.section_energy(global_section) = energy;
      });
}

#define SKEIN_INSTANTIATE(S)                                                                                          \
  template void add_spring_force<S>(const S&, const SpringArrays<S>&, IndexRange, const ConstVectorView<S>&,          \
                                    const VectorView<S>&);                                                            \
  template void add_spring_force_by_nodes<S>(const S&, const SpringArrays<S>&, IndexRange, const ConstVectorView<S>&, \
                                             const VectorView<S>&);                                                   \
  template void compute_spring_force_by_nodes<S>(const S&, const SpringArrays<S>&, const ConstVectorView<S>&,         \
                                                 const VectorView<S>&);                                               \
  template void seek_spring_measures<S>(const S&, const SpringArrays<S>&, const ConstVectorView<S>&,                  \
                                        const SpringMeasures<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
