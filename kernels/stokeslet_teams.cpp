#include "kernels/stokeslet_teams.hpp"

#include <skein/core/error.hpp>

#include "kernels/shared_source.hpp"

#include <cmath>
#include <cstddef>
#include <type_traits>

namespace skein {
namespace {

constexpr int tile_capacity = 128;     // sources that a team shares at once
constexpr int largest_team = 128;      // of double pairs; those of single ones hold two targets a thread, and are half
constexpr int shortest_run = 64;       // sources
constexpr double loads_at_once = 2.0;  // threads over what a device runs at once

/// Sources of a run are a multiple of this, so that the last tile of each is not much emptier than the others.
int round_up_run(const int n) {
  const int step = n > tile_capacity ? tile_capacity : tile_capacity / 4;
  return math::ceil_div(n, step) * step;
}

/// How far a tile reaches from its middle and what its pairs' scale is, for whether low parts of coordinates matter.
struct TileExtent {
  float reach_squared = 0.0F, blob_squared = 0.0F;  ///< the largest and the smallest

  /// As needs_low_parts of tiles of a host, for one target and a sphere about the tile.
  KOKKOS_INLINE_FUNCTION bool needs_low_parts(const Quad<float>& target) const {
    constexpr float allowed = 8.0F;
    const float distance = math::sqrt(target.x * target.x + target.y * target.y + target.z * target.z);
    const float reach = math::sqrt(reach_squared);
    const float farthest = distance > reach ? distance : reach, gap = farthest - reach;
    return !(farthest * farthest < allowed * allowed * (blob_squared + gap * gap));
  }
};

/// The work of one team: a block of targets and a run of sources.
template <class Real, class Space>
struct SumByTeams {
  static constexpr bool is_split = std::is_same_v<Real, float>;
  static constexpr int n_held = is_split ? 2 : 1;
  using Policy = Kokkos::TeamPolicy<Space, Kokkos::LaunchBounds<largest_team>>;
  using Team = typename Policy::member_type;
  using Scratch = typename Space::scratch_memory_space;
  using Tile = Kokkos::View<SharedSource<Real>*, Scratch, Kokkos::MemoryUnmanaged>;
  using LowTile = Kokkos::View<Quad<Real>*, Scratch, Kokkos::MemoryUnmanaged>;
  static constexpr int low_capacity = is_split ? tile_capacity : 1;

  ConstVectorView<Space> source_position, source_force;
  ConstScalarView<Space> blob;
  ConstVectorView<Space> target;
  double* sum;            ///< of the first run, x of the first target
  std::ptrdiff_t stride;  ///< from a component of it to the next; three of them from a run to the next
  double scale;           ///< of forces
  int n_blocks, run_sources;
  bool adds;  ///< to what there is

  static int scratch_bytes() {
    return static_cast<int>(Tile::shmem_size(tile_capacity) + LowTile::shmem_size(low_capacity));
  }

  KOKKOS_INLINE_FUNCTION void operator()(const Team& team) const {
    const Tile tile(team.team_scratch(0), tile_capacity);
    const LowTile low(team.team_scratch(0), low_capacity);
    const int run = team.league_rank() / n_blocks, block = team.league_rank() % n_blocks;
    const int n_targets = target.extent_int(0);
    // Neighbours share a thread, whatever the size of the team.
    const int first_target = (block * team.team_size() + team.team_rank()) * n_held;
    Vec3 x[n_held], total[n_held];
    for (int k = 0; k < n_held; ++k) x[k] = load(target, math::smaller(first_target + k, n_targets - 1));

    const int end = math::smaller(source_position.extent_int(0), (run + 1) * run_sources);
    for (int first = run * run_sources; first < end; first += tile_capacity) {
      const int count = math::smaller(tile_capacity, end - first);
      const Vec3 middle = is_split ? load(source_position, first + count / 2) : Vec3{};
      team.team_barrier();  // the tile may be overwritten
      const TileExtent extent = load_tile(team, first, count, middle, tile.data(), low.data());
      team.team_barrier();  // the tile is complete
      add_tile(x, middle, extent, tile.data(), low.data(), count, total);
    }
    for (int k = 0; k < n_held && first_target + k < n_targets; ++k) {
      double* const at = sum + 3 * run * stride + first_target + k;
      const double u[3] = {total[k].x, total[k].y, total[k].z};
      for (int c = 0; c < 3; ++c) at[c * stride] = adds ? at[c * stride] + u[c] : u[c];
    }
  }

  KOKKOS_INLINE_FUNCTION TileExtent load_tile(const Team& team, const int first, const int count, const Vec3 middle,
                                              SharedSource<Real>* tile, Quad<Real>* low) const {
    using Extremes = Kokkos::MinMax<float>;
    typename Extremes::value_type extremes;
    Extremes reducer(extremes);
    reducer.init(extremes);
    for (int s = team.team_rank(); s < count; s += team.team_size()) {
      const int i = first + s;
      const Vec3 y = load(source_position, i) - middle, f = scale * load(source_force, i);
      SharedSource<Real>& source = tile[s];
      source.place = {static_cast<Real>(y.x), static_cast<Real>(y.y), static_cast<Real>(y.z),
                      static_cast<Real>(blob(i) * blob(i))};
      source.force = {static_cast<Real>(f.x), static_cast<Real>(f.y), static_cast<Real>(f.z), Real(0)};
      if constexpr (is_split) {
        low[s] = rest_of(y, source.place);
        const float reach_squared = static_cast<float>(dot(y, y));
        if (reach_squared > extremes.max_val) extremes.max_val = reach_squared;
        if (source.place.w < extremes.min_val) extremes.min_val = source.place.w;
      }
    }
    if constexpr (is_split) team.team_reduce(reducer);
    return {extremes.max_val, extremes.min_val};
  }

  KOKKOS_INLINE_FUNCTION static Quad<Real> rest_of(const Vec3 exact, const Quad<Real>& rounded) {
    return {static_cast<Real>(exact.x - rounded.x), static_cast<Real>(exact.y - rounded.y),
            static_cast<Real>(exact.z - rounded.z), Real(0)};
  }

  KOKKOS_INLINE_FUNCTION static void add_tile(const Vec3 (&x)[n_held], const Vec3 middle, const TileExtent& extent,
                                              const SharedSource<Real>* tile, const Quad<Real>* low, const int count,
                                              Vec3 (&total)[n_held]) {
    HeldTargets<Real, n_held> held;
    bool with_low = false;
    for (int k = 0; k < n_held; ++k) {
      const Vec3 from_middle = is_split ? x[k] - middle : x[k];
      held.place[k] = {static_cast<Real>(from_middle.x), static_cast<Real>(from_middle.y),
                       static_cast<Real>(from_middle.z), Real(0)};
      if constexpr (is_split) {
        held.low[k] = rest_of(from_middle, held.place[k]);
        with_low = extent.needs_low_parts(held.place[k]) || with_low;
      }
      for (int c = 0; c < 3; ++c) held.velocity[k][c] = Real(0);
    }
    if (is_split && with_low)
      held.template add<is_split>(tile, low, count);
    else
      held.template add<false>(tile, low, count);
    for (int k = 0; k < n_held; ++k)
      total[k] = total[k] + Vec3{static_cast<double>(held.velocity[k][0]), static_cast<double>(held.velocity[k][1]),
                                 static_cast<double>(held.velocity[k][2])};
  }
};

/// velocity += partial sums, in the order of the runs.
template <class Space>
struct AddRuns {
  ConstScalarView<Space> partial;  ///< [n_runs, 3, n_targets]
  VectorView<Space> velocity;
  int n_runs;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    const int n = 3 * velocity.extent_int(0);
    double sum = 0.0;
    for (int run = 0; run < n_runs; ++run) sum += partial(static_cast<std::size_t>(run) * n + i);
    velocity(i % velocity.extent_int(0), i / velocity.extent_int(0)) += sum;
  }
};

template <class Space>
void require_partial_sums(ScalarView<Space>& partial, const std::size_t n) {
  if (partial.extent(0) >= n) return;
  partial = {};  // before the new one is allocated
  partial = ScalarView<Space>(Kokkos::ViewAllocateWithoutInitializing("skein::stokeslet_teams::partial"), n);
}

}  // namespace

TeamSplit choose_team_split(const int concurrency, const int n_sources, const int n_targets) {
  if (n_sources == 0 || n_targets == 0) return {};
  const double wanted = std::ceil(loads_at_once * concurrency / n_targets);
  const int most = math::ceil_div(n_sources, shortest_run);
  return {.n_runs = wanted < most ? math::larger(1, static_cast<int>(wanted)) : most};
}

template <class Space>
void add_stokeslet_velocity_by_teams(const Space& space, const ConstVectorView<Space>& source_position,
                                     const ConstVectorView<Space>& source_force, const ConstScalarView<Space>& blob,
                                     const ConstVectorView<Space>& target, const VectorView<Space>& velocity,
                                     const double viscosity, const Precision precision, const TeamSplit& split,
                                     ScalarView<Space>& partial) {
  SKEIN_REQUIRE(source_position.extent(0) == source_force.extent(0) && source_position.extent(0) == blob.extent(0),
                "positions, forces and blobs of the sources differ in number");
  SKEIN_REQUIRE(target.extent(0) == velocity.extent(0), "targets and velocities differ in number");
  SKEIN_REQUIRE(split.n_runs > 0 && split.team_size >= 0 && split.team_size <= largest_team,
                "a sum by teams needs a run, and teams of at most 128 threads");
  const int n_sources = source_position.extent_int(0), n_targets = target.extent_int(0);
  if (n_sources == 0 || n_targets == 0) return;
  const int run_sources = round_up_run(math::ceil_div(n_sources, split.n_runs));
  const int n_runs = math::ceil_div(n_sources, run_sources);
  if (n_runs > 1) require_partial_sums<Space>(partial, std::size_t{3} * n_runs * n_targets);
  with_precision(precision, [&](auto number) {
    using Sum = SumByTeams<decltype(number), Space>;
    const int usual = on_host<Space> ? 1 : largest_team / Sum::n_held;
    const int team_size = split.team_size > 0 ? split.team_size : usual;
    const int n_blocks = math::ceil_div(n_targets, team_size * Sum::n_held);
    typename Sum::Policy policy(space, n_runs * n_blocks, team_size);
    policy.set_scratch_size(0, Kokkos::PerTeam(Sum::scratch_bytes()));
    Kokkos::parallel_for("skein::add_stokeslet_velocity_by_teams", policy,
                         Sum{source_position, source_force, blob, target, n_runs > 1 ? partial.data() : velocity.data(),
                             n_runs > 1 ? n_targets : static_cast<std::ptrdiff_t>(velocity.stride(1)),
                             regularized_stokeslet::scale(viscosity), n_blocks, run_sources, n_runs == 1});
  });
  if (n_runs > 1)
    Kokkos::parallel_for("skein::add_runs", Kokkos::RangePolicy<Space>(space, 0, 3 * n_targets),
                         AddRuns<Space>{partial, velocity, n_runs});
}

#define SKEIN_INSTANTIATE(S)                                                                     \
  template void add_stokeslet_velocity_by_teams<S>(                                              \
      const S&, const ConstVectorView<S>&, const ConstVectorView<S>&, const ConstScalarView<S>&, \
      const ConstVectorView<S>&, const VectorView<S>&, double, Precision, const TeamSplit&, ScalarView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
