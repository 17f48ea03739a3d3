#include "fmm/device_translations.hpp"
#include "kernels/shared_source.hpp"

// The last pass: everything that ends at the targets of a leaf, so that their velocities are written once.

namespace skein {
namespace {

constexpr int part_targets = 128;  // of a leaf, that a team takes at once

template <class Space, class Real, class Field>
struct Leaves {
  OctreeCube cube;
  Kokkos::View<const Box*, Space> boxes;
  Kokkos::View<const int*, Space> target_leaves, near_end, target_order;
  DeviceLists<IndexRange, Space> u_list;
  DeviceLists<int, Space> w_list;
  DeviceNodes<Space> nodes;
  Field field;
  DeviceLevels<Space, Real> levels;
  DeviceCoefficients<Space, Real> coefficients;
};

/// The parts of leaves: leaf(i), and parts before it of the same leaf.
template <class Space>
struct LeafParts {
  Kokkos::View<int*, Space> leaf, place;
  int n = 0;
};

template <class Space>
LeafParts<Space> make_parts(const Space& space, const DeviceOctree<Space>& tree) {
  LeafParts<Space> parts;
  const int n_leaves = tree.n_target_leaves;
  const Kokkos::View<int*, Space> first(
      Kokkos::view_alloc(std::string("skein::device_leaves::first_part"), Kokkos::WithoutInitializing), n_leaves + 1);
  const auto boxes = tree.boxes;
  const auto leaves = tree.target_leaves;
  Kokkos::parallel_for(
      "skein::count_leaf_parts", Kokkos::RangePolicy<Space>(space, 0, n_leaves),
      KOKKOS_LAMBDA(const int i) { first(i) = math::ceil_div(boxes(leaves(i)).targets.count, part_targets); });
  parts.n = scan_counts(space, first, 0, n_leaves, 0);
  parts.leaf = Kokkos::View<int*, Space>(
      Kokkos::view_alloc(std::string("skein::device_leaves::part_leaf"), Kokkos::WithoutInitializing), parts.n);
  parts.place = Kokkos::View<int*, Space>(
      Kokkos::view_alloc(std::string("skein::device_leaves::part_place"), Kokkos::WithoutInitializing), parts.n);
  const auto leaf = parts.leaf, place = parts.place;
  Kokkos::parallel_for(
      "skein::list_leaf_parts", Kokkos::RangePolicy<Space>(space, 0, n_leaves), KOKKOS_LAMBDA(const int i) {
        for (int k = first(i); k < first(i + 1); ++k) {
          leaf(k) = i;
          place(k) = k - first(i);
        }
      });
  return parts;
}

/// U: a run of sources, directly. @param sum  [3][part_targets]
template <class Near, class Space, class Team>
KOKKOS_INLINE_FUNCTION void team_add_near(const Team& team, const DeviceNodes<Space>& nodes, const IndexRange& sources,
                                          const IndexRange& targets, const Vec3 center, SharedSource<Near>* tile,
                                          double* sum) {
  for (int first = 0; first < sources.count; first += team_tile) {
    const int count = math::smaller(team_tile, sources.count - first);
    team.team_barrier();  // the tile may be overwritten
    for (int s = team.team_rank(); s < count; s += team.team_size()) {
      const int i = sources.first + first + s;
      const Vec3 y = load(nodes.position, i) - center;
      const Vec3 force = load(nodes.force, i);
      tile[s].place = {static_cast<Near>(y.x), static_cast<Near>(y.y), static_cast<Near>(y.z),
                       static_cast<Near>(nodes.blob(i) * nodes.blob(i))};
      tile[s].force = {static_cast<Near>(force.x), static_cast<Near>(force.y), static_cast<Near>(force.z), Near(0)};
    }
    team.team_barrier();  // the tile is complete
    for (int t = team.team_rank(); t < targets.count; t += team.team_size()) {
      const Vec3 from_center = load(nodes.target, targets.first + t) - center;
      HeldTargets<Near, 1> held{{{static_cast<Near>(from_center.x), static_cast<Near>(from_center.y),
                                  static_cast<Near>(from_center.z), Near(0)}},
                                {},
                                {}};
      held.template add<false>(tile, nullptr, count);
      for (int c = 0; c < 3; ++c) sum[c * part_targets + t] += static_cast<double>(held.velocity[0][c]);
    }
  }
}

/// The densities on a box's surface, from its coefficients, and their velocity at the targets.
template <class Space, class Team, class Real, class Field>
KOKKOS_INLINE_FUNCTION void team_add_surface(const Team& team, const DeviceNodes<Space>& nodes, const Field& field,
                                             const DeviceOperatorSet<Real>& operators,
                                             const DeviceMatrix<Real>& to_density, const Real* coefficient,
                                             const int stride, const Real size, const Vec3 center,
                                             const double half_width, const IndexRange& targets, Real* density,
                                             double* sum) {
  team.team_barrier();  // densities may be overwritten
  team_multiply<Field::n_columns>(team, to_density, coefficient, stride,
                                  StoreProduct<Real>{density, to_density.n_rows});
  team.team_barrier();  // densities are complete
  const double to_units = 1.0 / half_width;
  for (int t = team.team_rank(); t < targets.count; t += team.team_size()) {
    const Vec3 from_center = to_units * (load(nodes.target, targets.first + t) - center);
    const Real x = static_cast<Real>(from_center.x), y = static_cast<Real>(from_center.y),
               z = static_cast<Real>(from_center.z);
    Real u[3] = {};
    for (int j = 0; j < operators.n_surface; ++j) {
      Real point[3], q[Field::n_planes];
      for (int c = 0; c < 3; ++c) point[c] = size * operators.surface_at(j, c);
      for (int plane = 0; plane < Field::n_planes; ++plane) q[plane] = density[plane * operators.n_padded + j];
      field.add_density(x, y, z, point, q, u);
    }
    for (int c = 0; c < 3; ++c) sum[c * part_targets + t] += to_units * static_cast<double>(u[c]);
  }
}

/// Everything that ends at some targets of a leaf.
template <class Near, class Space, class Team, class Real, class Field>
KOKKOS_INLINE_FUNCTION void team_add_part(const Team& team, const Leaves<Space, Real, Field>& leaves, const int leaf,
                                          const IndexRange& targets, SharedSource<Near>* tile, Real* density,
                                          double* sum) {
  const int b = leaves.target_leaves(leaf);
  const Box box = leaves.boxes(b);
  const Vec3 center = leaves.cube.center(box);
  const auto& coefficients = leaves.coefficients;
  for (int i = team.team_rank(); i < 3 * part_targets; i += team.team_size()) sum[i] = 0.0;
  team.team_barrier();  // sums are zero
  for (int k = leaves.u_list.first(leaf); k < leaves.near_end(leaf); ++k)
    team_add_near<Near>(team, leaves.nodes, leaves.u_list.entries(k), targets, center, tile, sum);
  if (box.level >= first_far_level) {
    const DeviceOperatorSet<Real>& operators = leaves.levels.sets(box.level);
    const double half_width = leaves.cube.half_width(box.level);
    team_add_surface(team, leaves.nodes, leaves.field.at(half_width), operators, operators.target_density,
                     coefficients.target.data() + static_cast<std::ptrdiff_t>(b) * coefficients.box_size,
                     coefficients.stride, static_cast<Real>(outer_surface), center, half_width, targets, density, sum);
  }
  for (int k = leaves.w_list.first(leaf); k < leaves.w_list.first(leaf + 1); ++k) {
    const int w = leaves.w_list.entries(k);
    const Box& fine = leaves.boxes(w);
    const DeviceOperatorSet<Real>& operators = leaves.levels.sets(fine.level);
    const double half_width = leaves.cube.half_width(fine.level);
    team_add_surface(team, leaves.nodes, leaves.field.at(half_width), operators, operators.source_density,
                     coefficients.source.data() + static_cast<std::ptrdiff_t>(w) * coefficients.box_size,
                     coefficients.stride, static_cast<Real>(inner_surface), leaves.cube.center(fine), half_width,
                     targets, density, sum);
  }
}

}  // namespace

template <class Space, class Near, class Real, class Field>
void add_leaf_velocities_by_teams(const Space& space, const DeviceOctree<Space>& tree, const DeviceNodes<Space>& nodes,
                                  const Field& field, const DeviceLevels<Space, Real>& levels,
                                  const DeviceCoefficients<Space, Real>& coefficients,
                                  const VectorView<Space>& velocity, const int team_size) {
  using Team = typename Kokkos::TeamPolicy<Space>::member_type;
  using Tile = TeamArray<Space, SharedSource<Near>>;
  using Densities = TeamArray<Space, Real>;
  using Sums = TeamArray<Space, double>;
  const LeafParts<Space> parts = make_parts(space, tree);
  if (parts.n == 0) return;
  const Leaves<Space, Real, Field> leaves{
      tree.cube, tree.boxes, tree.target_leaves, tree.near_end, tree.target_order(), tree.u_list, tree.w_list, nodes,
      field,     levels,     coefficients};
  const int n_densities = math::larger(1, Field::n_planes * levels.n_padded);
  const std::size_t n_bytes = Tile::shmem_size(team_tile) +
                              Densities::shmem_size(static_cast<std::size_t>(n_densities)) +
                              Sums::shmem_size(3 * part_targets);
  const int scratch_level = choose_scratch_level(n_bytes);
  Kokkos::parallel_for(
      "skein::add_leaf_velocities_by_teams", make_team_policy(space, parts.n, team_size, scratch_level, n_bytes),
      KOKKOS_LAMBDA(const Team& team) {
        const Tile tile(team.team_scratch(scratch_level), team_tile);
        const Densities density(team.team_scratch(scratch_level), n_densities);
        const Sums sum(team.team_scratch(scratch_level), 3 * part_targets);
        const int leaf = parts.leaf(team.league_rank());
        const int before = parts.place(team.league_rank()) * part_targets;
        IndexRange targets = leaves.boxes(leaves.target_leaves(leaf)).targets;
        targets.first += before;
        targets.count = math::smaller(part_targets, targets.count - before);
        team_add_part<Near>(team, leaves, leaf, targets, tile.data(), density.data(), sum.data());
        for (int t = team.team_rank(); t < targets.count; t += team.team_size()) {
          const int i = leaves.target_order(targets.first + t);
          for (int c = 0; c < 3; ++c) velocity(i, c) += sum(c * part_targets + t);
        }
      });
}

#define SKEIN_INSTANTIATE_FOR(S, Near, Real, Field)                                                        \
  template void add_leaf_velocities_by_teams<S, Near, Real, Field>(                                        \
      const S&, const DeviceOctree<S>&, const DeviceNodes<S>&, const Field&, const DeviceLevels<S, Real>&, \
      const DeviceCoefficients<S, Real>&, const VectorView<S>&, int);
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
