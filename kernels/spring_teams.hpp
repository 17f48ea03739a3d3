#pragma once

#include "kernels/spring_node.hpp"

namespace skein {

/// Force on one node of all its springs, or of a share.
template <class Space>
KOKKOS_INLINE_FUNCTION Vec3 force_on_node(const SpringArrays<Space>& springs, const ConstVectorView<Space>& position,
                                          const int node, const int share = 0, const int n_shares = 1) {
  const Vec3 x = load(position, node);
  Vec3 force;
  for_each_spring<Space>(
      springs, node,
      [&](const int other, const double stiffness, const double inverse_rest_length) {
        const Vec3 d = x - load(position, other);
        const double r_squared = dot(d, d);
        if (r_squared == 0.0) return;
        force = force + stiffness * (math::inverse_sqrt(r_squared) - inverse_rest_length) * d;
      },
      share, n_shares);
  return force;
}

/// Forces on some of the nodes, a few to a team and a few workers to each node: small fibers alone would not keep a
/// device busy. Partial forces are added in the order of the workers, whatever the size of the team.
template <class Space>
struct ForcesByTeams {
  static constexpr int n_shares = 8, team_nodes = 16, n_workers = n_shares * team_nodes;
  using Policy = Kokkos::TeamPolicy<Space>;
  using Team = typename Policy::member_type;
  using Partial = Kokkos::View<Vec3*, typename Space::scratch_memory_space, Kokkos::MemoryUnmanaged>;

  SpringArrays<Space> springs;
  ConstVectorView<Space> position;
  VectorView<Space> force;
  IndexRange nodes;
  bool adds;

  KOKKOS_INLINE_FUNCTION void operator()(const Team& team) const {
    const Partial partial(team.team_scratch(0), n_workers);
    const int before = team.league_rank() * team_nodes, first = nodes.first + before;
    const int count = math::smaller(team_nodes, nodes.count - before);
    for (int worker = team.team_rank(); worker < n_shares * count; worker += team.team_size())
      partial(worker) = force_on_node<Space>(springs, position, first + worker / n_shares, worker % n_shares, n_shares);
    team.team_barrier();  // partial forces are complete
    for (int node = team.team_rank(); node < count; node += team.team_size()) {
      Vec3 sum = adds ? load(force, first + node) : Vec3{};
      for (int share = 0; share < n_shares; ++share) sum = sum + partial(node * n_shares + share);
      store(force, first + node, sum);
    }
  }
};

}  // namespace skein
