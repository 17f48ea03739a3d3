#include "kernels/stokeslet_direct.hpp"

#include <skein/core/error.hpp>

#include "kernels/stokeslet_block.hpp"

#include <utility>

namespace skein {
namespace {

constexpr int device_team_size = 128;

template <class Real>
void add_on_host(const HostSpace& space, const HostSources& sources, const ConstVectorView<HostSpace>& target,
                 const VectorView<HostSpace>& velocity) {
  const int n_sources = sources.position.extent_int(0);
  const int n_targets = target.extent_int(0);
  Kokkos::parallel_for("skein::add_stokeslet_velocity",
                       Kokkos::RangePolicy<HostSpace, Kokkos::Schedule<Kokkos::Dynamic>>(
                           space, 0, math::ceil_div(n_targets, block_targets)),
                       [=](const int block) {
                         const int first = block * block_targets;
                         bool given = false;
                         const auto all_sources = [&](IndexRange& run) {
                           run = {0, n_sources};
                           return !std::exchange(given, true);
                         };
                         add_runs_to_targets<Real>(sources, all_sources, target,
                                                   {first, math::smaller(block_targets, n_targets - first)}, velocity);
                       });
}

/// One thread per target; the team shares a tile of sources.
template <class Real, class Space>
void add_by_teams(const Space& space, const ConstVectorView<Space>& source_position,
                  const ConstVectorView<Space>& source_force, const ConstScalarView<Space>& blob,
                  const ConstVectorView<Space>& target, const VectorView<Space>& velocity, const double scale,
                  const int team_size) {
  using Policy = Kokkos::TeamPolicy<Space>;
  using Team = typename Policy::member_type;
  using ScratchVectors = Kokkos::View<double* [3], typename Space::scratch_memory_space, Kokkos::MemoryUnmanaged>;
  using ScratchForces = Kokkos::View<Real* [4], typename Space::scratch_memory_space, Kokkos::MemoryUnmanaged>;

  const int n_sources = source_position.extent_int(0);
  const int n_targets = target.extent_int(0);
  Policy policy(space, math::ceil_div(n_targets, team_size), team_size);
  policy.set_scratch_size(0, Kokkos::PerTeam(static_cast<int>(ScratchVectors::shmem_size(tile_sources) +
                                                              ScratchForces::shmem_size(tile_sources))));

  Kokkos::parallel_for(
      "skein::add_stokeslet_velocity_by_teams", policy, KOKKOS_LAMBDA(const Team& team) {
        const ScratchVectors position(team.team_scratch(0), tile_sources);
        const ScratchForces force(team.team_scratch(0), tile_sources);  // and the square of the blob
        const int t = team.league_rank() * team.team_size() + team.team_rank();
        const bool is_target = t < n_targets;
        const Vec3 x = is_target ? load(target, t) : Vec3{};
        double sum_x = 0.0, sum_y = 0.0, sum_z = 0.0;

        for (int first = 0; first < n_sources; first += tile_sources) {
          const int n_tile = math::smaller(tile_sources, n_sources - first);
          for (int s = team.team_rank(); s < n_tile; s += team.team_size()) {
            for (int c = 0; c < 3; ++c) {
              position(s, c) = source_position(first + s, c);
              force(s, c) = static_cast<Real>(scale * source_force(first + s, c));
            }
            force(s, 3) = static_cast<Real>(blob(first + s) * blob(first + s));
          }
          team.team_barrier();  // the tile is complete
          if (is_target) {
            Real ux = 0, uy = 0, uz = 0;
            for (int s = 0; s < n_tile; ++s) {
              const Real dx = static_cast<Real>(x.x - position(s, 0));
              const Real dy = static_cast<Real>(x.y - position(s, 1));
              const Real dz = static_cast<Real>(x.z - position(s, 2));
              const auto weight = regularized_stokeslet::weights(dx, dy, dz, force(s, 3));
              regularized_stokeslet::add(weight, dx, dy, dz, force(s, 0), force(s, 1), force(s, 2), ux, uy, uz);
            }
            sum_x += static_cast<double>(ux);
            sum_y += static_cast<double>(uy);
            sum_z += static_cast<double>(uz);
          }
          team.team_barrier();  // the tile may be overwritten
        }
        if (is_target) store(velocity, t, load(velocity, t) + Vec3{sum_x, sum_y, sum_z});
      });
}

template <class Space>
void check_extents(const ConstVectorView<Space>& source_position, const ConstVectorView<Space>& source_force,
                   const ConstScalarView<Space>& blob, const ConstVectorView<Space>& target,
                   const VectorView<Space>& velocity) {
  SKEIN_REQUIRE(source_position.extent(0) == source_force.extent(0) && source_position.extent(0) == blob.extent(0),
                "positions, forces and blobs of the sources differ in number");
  SKEIN_REQUIRE(target.extent(0) == velocity.extent(0), "targets and velocities differ in number");
}

}  // namespace

template <class Space>
void add_stokeslet_velocity(const Space& space, const ConstVectorView<Space>& source_position,
                            const ConstVectorView<Space>& source_force, const ConstScalarView<Space>& blob,
                            const ConstVectorView<Space>& target, const VectorView<Space>& velocity,
                            const double viscosity, const Precision precision) {
  check_extents<Space>(source_position, source_force, blob, target, velocity);
  if (source_position.extent(0) == 0 || target.extent(0) == 0) return;
  if constexpr (on_host<Space>) {
    const HostSources sources{source_position, source_force, blob, regularized_stokeslet::scale(viscosity)};
    with_precision(precision, [&](auto number) { add_on_host<decltype(number)>(space, sources, target, velocity); });
  } else {
    add_stokeslet_velocity_by_teams<Space>(space, source_position, source_force, blob, target, velocity, viscosity,
                                           precision, device_team_size);
  }
}

template <class Space>
void add_stokeslet_velocity_by_teams(const Space& space, const ConstVectorView<Space>& source_position,
                                     const ConstVectorView<Space>& source_force, const ConstScalarView<Space>& blob,
                                     const ConstVectorView<Space>& target, const VectorView<Space>& velocity,
                                     const double viscosity, const Precision precision, const int team_size) {
  check_extents<Space>(source_position, source_force, blob, target, velocity);
  SKEIN_REQUIRE(team_size > 0, "a team needs a thread");
  if (source_position.extent(0) == 0 || target.extent(0) == 0) return;
  const double scale = regularized_stokeslet::scale(viscosity);
  with_precision(precision, [&](auto number) {
    add_by_teams<decltype(number), Space>(space, source_position, source_force, blob, target, velocity, scale,
                                          team_size);
  });
}

#define SKEIN_INSTANTIATE(S)                                                                                          \
  template void add_stokeslet_velocity<S>(const S&, const ConstVectorView<S>&, const ConstVectorView<S>&,             \
                                          const ConstScalarView<S>&, const ConstVectorView<S>&, const VectorView<S>&, \
                                          double, Precision);                                                         \
  template void add_stokeslet_velocity_by_teams<S>(const S&, const ConstVectorView<S>&, const ConstVectorView<S>&,    \
                                                   const ConstScalarView<S>&, const ConstVectorView<S>&,              \
                                                   const VectorView<S>&, double, Precision, int);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
