#include "fmm/box_passes.hpp"
#include "fmm/leaf_sums.hpp"
#include "fmm/team_sum.hpp"
#include "kernels/shared_source.hpp"

// The last pass: everything that ends at the targets of a leaf, so that their velocities are written once.

namespace skein {
namespace {

/// How the targets of a part share the threads of a team: each is held by several workers, which take different
/// sources; a worker holds one target or two, because what it reads of a source serves both. Sums are those of the
/// workers, whatever the team that does their work.
template <class Near>
struct PartShape {
  static constexpr int n_workers = team_part_targets;
  static constexpr int n_held = std::is_same_v<Near, float> ? 2 : 1;
  static constexpr int n_sums = 3 * n_workers * n_held;

  IndexRange targets;
  int n_slots;   ///< workers beside each other
  int n_shares;  ///< of the sources

  KOKKOS_INLINE_FUNCTION explicit PartShape(const IndexRange& of) : targets(of), n_slots(n_workers) {
    while (n_slots > 32 && (n_slots / 2) * n_held >= targets.count) n_slots /= 2;
    n_shares = n_workers / n_slots;
  }
  KOKKOS_INLINE_FUNCTION int slot(const int worker) const { return worker % n_slots; }
  /// Of n sources or points, those of the worker.
  KOKKOS_INLINE_FUNCTION IndexRange share(const int worker, const int n) const {
    const int k = worker / n_slots, first = k * n / n_shares;
    return {first, (k + 1) * n / n_shares - first};
  }
  /// The k-th target that a worker holds; the last one again where there are no more.
  KOKKOS_INLINE_FUNCTION int target(const int worker, const int k) const {
    return targets.first + math::smaller(slot(worker) + k * n_slots, targets.count - 1);
  }
  KOKKOS_INLINE_FUNCTION void add(double* sum, const int worker, const int k, const Vec3 u) const {
    double* const at = sum + k * n_workers + worker;
    at[0] += u.x;
    at[n_workers * n_held] += u.y;
    at[2 * n_workers * n_held] += u.z;
  }
  /// Component c of target t of the part, of all shares in their order.
  KOKKOS_INLINE_FUNCTION double total(const double* sum, const int t, const int c) const {
    const double* const at = sum + (c * n_held + t / n_slots) * n_workers + t % n_slots;
    double all = at[0];
    for (int k = 1; k < n_shares; ++k) all += at[k * n_slots];
    return all;
  }
};

/// U: runs of sources, directly; tiles are filled from one run after the other.
template <class Near, class Space, class Team>
KOKKOS_INLINE_FUNCTION void team_add_near(const Team& team, const SortedNodes<Space>& nodes, const IndexRange* run,
                                          const IndexRange* const end, const PartShape<Near>& shape, const Vec3 center,
                                          SharedSource<Near>* tile, double* sum) {
  int taken = 0;  // of the first of the runs that are left
  while (run != end) {
    team.team_barrier();  // the tile may be overwritten
    int count = 0;
    while (count < source_tile && run != end) {
      const int from = run->first + taken, n = math::smaller(source_tile - count, run->count - taken);
      for (int s = team.team_rank(); s < n; s += team.team_size()) {
        const Vec3 y = load(nodes.position, from + s) - center, force = load(nodes.force, from + s);
        const double blob = nodes.blob(from + s);
        tile[count + s] = {
            {static_cast<Near>(y.x), static_cast<Near>(y.y), static_cast<Near>(y.z), static_cast<Near>(blob * blob)},
            {static_cast<Near>(force.x), static_cast<Near>(force.y), static_cast<Near>(force.z), Near(0)}};
      }
      count += n;
      taken += n;
      if (taken == run->count) {
        ++run;
        taken = 0;
      }
    }
    team.team_barrier();  // the tile is complete
    for (int worker = team.team_rank(); worker < shape.n_workers; worker += team.team_size()) {
      if (shape.slot(worker) >= shape.targets.count) continue;
      HeldTargets<Near, PartShape<Near>::n_held> held{};
      for (int k = 0; k < shape.n_held; ++k) {
        const Vec3 x = load(nodes.target, shape.target(worker, k)) - center;
        held.place[k] = {static_cast<Near>(x.x), static_cast<Near>(x.y), static_cast<Near>(x.z), Near(0)};
      }
      const IndexRange share = shape.share(worker, count);
      held.template add<false>(tile + share.first, nullptr, share.count);
      for (int k = 0; k < shape.n_held; ++k)
        shape.add(sum, worker, k,
                  {static_cast<double>(held.velocity[k][0]), static_cast<double>(held.velocity[k][1]),
                   static_cast<double>(held.velocity[k][2])});
    }
  }
}

/// Some targets of a leaf, and what a team has summed for them.
template <class Near, class Space, class Real, class Field>
struct TeamPart {
  const TeamWorker<Space>& worker;
  const Passes<Space, Real, Field>& passes;
  PartShape<Near> shape;
  Real* density;
  double* sum;

  /// Velocity of the densities on a box's surface, from its coefficients.
  KOKKOS_INLINE_FUNCTION void add_surface(const LevelOperators<Real>& operators, const Matrix<Real>& to_density,
                                          const Real* coefficients, const Real size, const Box& box) {
    constexpr int n_held = PartShape<Near>::n_held;
    worker.barrier();  // densities may be overwritten
    worker.template multiply<Field::n_columns>(to_density, coefficients, passes.coefficients.stride,
                                               StoreProduct<Real>{density, to_density.n_rows});
    worker.barrier();  // densities are complete
    const double half_width = passes.cube.half_width(box.level), to_units = 1.0 / half_width;
    const Vec3 center = passes.cube.center(box);
    const Field field = passes.field.at(half_width);
    for (int slot = worker.rank(); slot < shape.n_workers; slot += worker.size()) {
      if (shape.slot(slot) >= shape.targets.count) continue;
      Real x[n_held][3], u[n_held][3] = {};
      for (int k = 0; k < n_held; ++k) {
        const Vec3 from_center = to_units * (load(passes.nodes.target, shape.target(slot, k)) - center);
        x[k][0] = static_cast<Real>(from_center.x);
        x[k][1] = static_cast<Real>(from_center.y);
        x[k][2] = static_cast<Real>(from_center.z);
      }
      add_densities(field, operators, size, density, shape.share(slot, operators.n_surface), x, u);
      for (int k = 0; k < n_held; ++k)
        shape.add(
            sum, slot, k,
            to_units * Vec3{static_cast<double>(u[k][0]), static_cast<double>(u[k][1]), static_cast<double>(u[k][2])});
    }
  }

  /// Of those that share targets the first ones work.
  KOKKOS_INLINE_FUNCTION void add_polynomials(const Real* coefficients, const Box& box) {
    const double to_units = 1.0 / passes.cube.half_width(box.level);
    const Vec3 center = passes.cube.center(box);
    for (int slot = worker.rank(); slot < shape.n_slots; slot += worker.size()) {
      if (slot >= shape.targets.count) continue;
      for (int k = 0; k < shape.n_held; ++k) {
        const Vec3 from_center = to_units * (load(passes.nodes.target, shape.target(slot, k)) - center);
        const Real x[3] = {static_cast<Real>(from_center.x), static_cast<Real>(from_center.y),
                           static_cast<Real>(from_center.z)};
        Real u[3] = {};
        add_tail_velocity<Real>(passes.field.degree, coefficients, x, u);
        shape.add(sum, slot, k,
                  to_units * Vec3{static_cast<double>(u[0]), static_cast<double>(u[1]), static_cast<double>(u[2])});
      }
    }
  }
};

/// Everything that ends at some targets of a leaf: a part of one to a team.
template <class Near, class Space, class Real, class Field>
struct SumLeafParts {
  Passes<Space, Real, Field> passes;
  LeafParts<Space> parts;
  VectorView<Space> velocity;
  int n_densities, scratch_level;

  KOKKOS_INLINE_FUNCTION void operator()(const typename TeamWorker<Space>::Team& team) const {
    using Shape = PartShape<Near>;
    if (team.league_rank() >= parts.first(parts.n_leaves)) return;
    const TeamWorker<Space> worker{team, scratch_level};
    const auto tile = worker.template array<SharedSource<Near>>(source_tile);
    const auto density = worker.template array<Real>(n_densities);
    const auto sum = worker.template array<double>(Shape::n_sums);
    const int leaf = parts.leaf(team.league_rank());
    const int before = parts.place(team.league_rank()) * team_part_targets;
    const Box& box = passes.boxes(passes.target_leaves(leaf));
    const Shape shape({box.targets.first + before, math::smaller(team_part_targets, box.targets.count - before)});
    fill_zeros(worker, sum.data(), Shape::n_sums);
    worker.barrier();  // sums are zero
    const IndexRange* const runs = passes.u_list.entries.data();
    if constexpr (!std::is_same_v<Field, TailField>)  // which comes after all else
      team_add_near<Near>(team, passes.nodes, runs + passes.u_list.first(leaf), runs + passes.near_end(leaf), shape,
                          passes.cube.center(box), tile.data(), sum.data());
    TeamPart<Near, Space, Real, Field> part{worker, passes, shape, density.data(), sum.data()};
    add_expansions(part, passes, leaf);
    worker.barrier();  // sums are complete
    for (int t = worker.rank(); t < shape.targets.count; t += worker.size()) {
      const int i = passes.target_order(shape.targets.first + t);
      for (int c = 0; c < 3; ++c)
        velocity(i, c) = (std::is_same_v<Field, TailField> ? velocity(i, c) : 0.0) + shape.total(sum.data(), t, c);
    }
  }
};

}  // namespace

template <class Space, class Near, class Real, class Field>
void sum_leaf_velocities_by_teams(const Space& space, const Passes<Space, Real, Field>& passes,
                                  const LeafParts<Space>& parts, const VectorView<Space>& velocity,
                                  const int team_size) {
  if (parts.n_parts == 0) return;
  using Scratch = TeamScratch<Space>;
  const int n_densities = math::larger(1, Field::n_planes * passes.levels.n_padded);
  const std::size_t n_bytes = Scratch::template array_bytes<SharedSource<Near>>(source_tile) +
                              Scratch::template array_bytes<Real>(n_densities) +
                              Scratch::template array_bytes<double>(PartShape<Near>::n_sums);
  const int scratch_level = choose_scratch_level(n_bytes);
  Kokkos::parallel_for("skein::sum_leaf_velocities_by_teams",
                       make_team_policy(space, parts.n_parts, team_size, scratch_level, n_bytes),
                       SumLeafParts<Near, Space, Real, Field>{passes, parts, velocity, n_densities, scratch_level});
}

#define SKEIN_INSTANTIATE_FOR(S, Near, Real, Field)                                                         \
  template void sum_leaf_velocities_by_teams<S, Near, Real, Field>(const S&, const Passes<S, Real, Field>&, \
                                                                   const LeafParts<S>&, const VectorView<S>&, int);
#define SKEIN_INSTANTIATE_FIELD(S, Field)         \
  SKEIN_INSTANTIATE_FOR(S, double, double, Field) \
  SKEIN_INSTANTIATE_FOR(S, double, float, Field)  \
  SKEIN_INSTANTIATE_FOR(S, float, float, Field)
#define SKEIN_INSTANTIATE(S)                 \
  SKEIN_INSTANTIATE_FIELD(S, HarmonicField)  \
  SKEIN_INSTANTIATE_FIELD(S, TailField)      \
  SKEIN_INSTANTIATE_FIELD(S, StokesletField) \
  SKEIN_INSTANTIATE_FIELD(S, RegularizedField)
SKEIN_INSTANTIATE(ExecSpace)

}  // namespace skein
