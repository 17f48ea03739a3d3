#include "fmm/device_translations.hpp"
#include "kernels/shared_source.hpp"

// The last pass: everything that ends at the targets of a leaf, so that their velocities are written once.

namespace skein {
namespace {

template <class Space, class Real, class Field>
struct Leaves {
  OctreeCube cube;
  Kokkos::View<const Box*, Space> boxes;
  Kokkos::View<const int*, Space> target_leaves, near_end, target_order;
  Lists<IndexRange, Space> u_list;
  Lists<int, Space> w_list;
  DeviceNodes<Space> nodes;
  Field field;
  DeviceLevels<Space, Real> levels;
  DeviceCoefficients<Space, Real> coefficients;
};

/// How the targets of a part share the threads of a team: each is held by several workers, which take different
/// sources; a worker holds one target or two, because what it reads of a source serves both. Sums are those of the
/// workers, whatever the team that does their work.
template <class Near>
struct PartShape {
  static constexpr int n_workers = part_targets;
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
KOKKOS_INLINE_FUNCTION void team_add_near(const Team& team, const DeviceNodes<Space>& nodes, const IndexRange* run,
                                          const IndexRange* const end, const PartShape<Near>& shape, const Vec3 center,
                                          SharedSource<Near>* tile, double* sum) {
  int taken = 0;  // of the first of the runs that are left
  while (run != end) {
    team.team_barrier();  // the tile may be overwritten
    int count = 0;
    while (count < team_tile && run != end) {
      const int from = run->first + taken, n = math::smaller(team_tile - count, run->count - taken);
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

/// The densities on a box's surface, from its coefficients, and their velocity at the targets.
template <class Near, class Space, class Team, class Real, class Field>
KOKKOS_INLINE_FUNCTION void team_add_surface(const Team& team, const DeviceNodes<Space>& nodes, const Field& field,
                                             const DeviceOperatorSet<Real>& operators,
                                             const DeviceMatrix<Real>& to_density, const Real* coefficient,
                                             const int stride, const Real size, const Vec3 center,
                                             const double half_width, const PartShape<Near>& shape, Real* density,
                                             double* sum) {
  team.team_barrier();  // densities may be overwritten
  team_multiply<Field::n_columns>(team, to_density, coefficient, stride,
                                  StoreProduct<Real>{density, to_density.n_rows});
  team.team_barrier();  // densities are complete
  const double to_units = 1.0 / half_width;
  for (int worker = team.team_rank(); worker < shape.n_workers; worker += team.team_size()) {
    if (shape.slot(worker) >= shape.targets.count) continue;
    Real x[PartShape<Near>::n_held][3], u[PartShape<Near>::n_held][3] = {};
    for (int k = 0; k < shape.n_held; ++k) {
      const Vec3 from_center = to_units * (load(nodes.target, shape.target(worker, k)) - center);
      x[k][0] = static_cast<Real>(from_center.x);
      x[k][1] = static_cast<Real>(from_center.y);
      x[k][2] = static_cast<Real>(from_center.z);
    }
    const IndexRange share = shape.share(worker, operators.n_surface);
    for (int j = share.first; j < share.first + share.count; ++j) {
      Real point[3], q[Field::n_planes];
      for (int c = 0; c < 3; ++c) point[c] = size * operators.surface_at(j, c);
      for (int plane = 0; plane < Field::n_planes; ++plane) q[plane] = density[plane * operators.n_padded + j];
      for (int k = 0; k < shape.n_held; ++k) field.add_density(x[k][0], x[k][1], x[k][2], point, q, u[k]);
    }
    for (int k = 0; k < shape.n_held; ++k)
      shape.add(
          sum, worker, k,
          to_units * Vec3{static_cast<double>(u[k][0]), static_cast<double>(u[k][1]), static_cast<double>(u[k][2])});
  }
}

/// Everything that ends at some targets of a leaf.
template <class Near, class Space, class Team, class Real, class Field>
KOKKOS_INLINE_FUNCTION void team_add_part(const Team& team, const Leaves<Space, Real, Field>& leaves, const int leaf,
                                          const PartShape<Near>& shape, SharedSource<Near>* tile, Real* density,
                                          double* sum) {
  const int b = leaves.target_leaves(leaf);
  const Box box = leaves.boxes(b);
  const Vec3 center = leaves.cube.center(box);
  const auto& coefficients = leaves.coefficients;
  for (int i = team.team_rank(); i < shape.n_sums; i += team.team_size()) sum[i] = 0.0;
  team.team_barrier();  // sums are zero
  team_add_near<Near>(team, leaves.nodes, leaves.u_list.entries.data() + leaves.u_list.first(leaf),
                      leaves.u_list.entries.data() + leaves.near_end(leaf), shape, center, tile, sum);
  if (box.level >= first_far_level) {
    const DeviceOperatorSet<Real>& operators = leaves.levels.sets(box.level);
    const double half_width = leaves.cube.half_width(box.level);
    team_add_surface(team, leaves.nodes, leaves.field.at(half_width), operators, operators.target_density,
                     coefficients.target.data() + static_cast<std::ptrdiff_t>(b) * coefficients.box_size,
                     coefficients.stride, static_cast<Real>(outer_surface), center, half_width, shape, density, sum);
  }
  for (int k = leaves.w_list.first(leaf); k < leaves.w_list.first(leaf + 1); ++k) {
    const int w = leaves.w_list.entries(k);
    const Box& fine = leaves.boxes(w);
    const DeviceOperatorSet<Real>& operators = leaves.levels.sets(fine.level);
    const double half_width = leaves.cube.half_width(fine.level);
    team_add_surface(team, leaves.nodes, leaves.field.at(half_width), operators, operators.source_density,
                     coefficients.source.data() + static_cast<std::ptrdiff_t>(w) * coefficients.box_size,
                     coefficients.stride, static_cast<Real>(inner_surface), leaves.cube.center(fine), half_width, shape,
                     density, sum);
  }
}

}  // namespace

template <class Space, class Near, class Real, class Field>
void sum_leaf_velocities_by_teams(const Space& space, const Octree<Space>& tree, const LeafParts<Space>& parts,
                                  const DeviceNodes<Space>& nodes, const Field& field,
                                  const DeviceLevels<Space, Real>& levels,
                                  const DeviceCoefficients<Space, Real>& coefficients,
                                  const VectorView<Space>& velocity, const int team_size) {
  using Team = typename Kokkos::TeamPolicy<Space>::member_type;
  using Tile = TeamArray<Space, SharedSource<Near>>;
  using Densities = TeamArray<Space, Real>;
  using Sums = TeamArray<Space, double>;
  using Shape = PartShape<Near>;
  if (parts.n_parts == 0) return;
  const Leaves<Space, Real, Field> leaves{
      tree.cube, tree.boxes, tree.target_leaves, tree.near_end, tree.target_order(), tree.u_list, tree.w_list, nodes,
      field,     levels,     coefficients};
  const int n_densities = math::larger(1, Field::n_planes * levels.n_padded);
  const std::size_t n_bytes = Tile::shmem_size(team_tile) +
                              Densities::shmem_size(static_cast<std::size_t>(n_densities)) +
                              Sums::shmem_size(Shape::n_sums);
  const int scratch_level = choose_scratch_level(n_bytes);
  const auto part_leaf = parts.leaf, part_place = parts.place;
  Kokkos::parallel_for(
      "skein::sum_leaf_velocities_by_teams", make_team_policy(space, parts.n_parts, team_size, scratch_level, n_bytes),
      KOKKOS_LAMBDA(const Team& team) {
        const Tile tile(team.team_scratch(scratch_level), team_tile);
        const Densities density(team.team_scratch(scratch_level), n_densities);
        const Sums sum(team.team_scratch(scratch_level), Shape::n_sums);
        const int leaf = part_leaf(team.league_rank()), before = part_place(team.league_rank()) * part_targets;
        const IndexRange all = leaves.boxes(leaves.target_leaves(leaf)).targets;
        const Shape shape({all.first + before, math::smaller(part_targets, all.count - before)});
        team_add_part<Near>(team, leaves, leaf, shape, tile.data(), density.data(), sum.data());
        team.team_barrier();  // sums are complete
        for (int t = team.team_rank(); t < shape.targets.count; t += team.team_size()) {
          const int i = leaves.target_order(shape.targets.first + t);
          for (int c = 0; c < 3; ++c) velocity(i, c) = shape.total(sum.data(), t, c);
        }
      });
}

#define SKEIN_INSTANTIATE_FOR(S, Near, Real, Field)                                         \
  template void sum_leaf_velocities_by_teams<S, Near, Real, Field>(                         \
      const S&, const Octree<S>&, const LeafParts<S>&, const DeviceNodes<S>&, const Field&, \
      const DeviceLevels<S, Real>&, const DeviceCoefficients<S, Real>&, const VectorView<S>&, int);
#define SKEIN_INSTANTIATE_FIELD(S, Field)         \
  SKEIN_INSTANTIATE_FOR(S, double, double, Field) \
  SKEIN_INSTANTIATE_FOR(S, double, float, Field)  \
  SKEIN_INSTANTIATE_FOR(S, float, float, Field)
#define SKEIN_INSTANTIATE(S)                 \
  SKEIN_INSTANTIATE_FIELD(S, HarmonicField)  \
  SKEIN_INSTANTIATE_FIELD(S, StokesletField) \
  SKEIN_INSTANTIATE_FIELD(S, RegularizedField)
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
