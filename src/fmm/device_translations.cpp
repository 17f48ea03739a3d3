#include "fmm/device_translations.hpp"

#include "fmm/device_transfers.hpp"

namespace skein {
namespace {

template <class Space, class Real, class Field>
struct PotentialScratch {
  explicit PotentialScratch(const DeviceLevels<Space, Real>& levels) : n_values(Field::n_planes * levels.n_padded) {}
  std::size_t bytes() const {
    return TeamArray<Space, Real>::shmem_size(static_cast<std::size_t>(n_values)) +
           TeamArray<Space, FarSource<Real>>::shmem_size(team_tile);
  }
  int n_values;
};

/// Sources of leaves to their coefficients (P2M).
template <class Space, class Real, class Field>
void run_p2m(const Space& space, const Passes<Space, Real, Field>& passes, const IndexRange boxes,
             const int team_size) {
  using Team = typename Kokkos::TeamPolicy<Space>::member_type;
  const PotentialScratch<Space, Real, Field> scratch(passes.levels);
  const int scratch_level = choose_scratch_level(scratch.bytes());
  const int n_values = scratch.n_values;
  Kokkos::parallel_for(
      "skein::run_p2m", make_team_policy(space, boxes.count, team_size, scratch_level, scratch.bytes()),
      KOKKOS_LAMBDA(const Team& team) {
        const int b = boxes.first + team.league_rank();
        const Box box = passes.boxes(b);
        if (!box.is_leaf() || box.sources.count == 0) return;
        const TeamArray<Space, Real> potential(team.team_scratch(scratch_level), n_values);
        const TeamArray<Space, FarSource<Real>> tile(team.team_scratch(scratch_level), team_tile);
        const DeviceOperatorSet<Real>& operators = passes.levels.sets(box.level);
        for (int i = team.team_rank(); i < n_values; i += team.team_size()) potential(i) = 0;
        const double half_width = passes.cube.half_width(box.level);
        team_add_potentials(team, passes.nodes, box.sources, passes.cube.center(box), half_width,
                            passes.field.at(half_width), operators, static_cast<Real>(outer_surface), tile.data(),
                            potential.data());
        team.team_barrier();  // potentials are complete
        team_multiply<Field::n_columns>(team, operators.to_source, potential.data(), operators.to_source.n_columns,
                                        StoreProduct<Real>{passes.source_of(b), passes.coefficients.stride});
      });
}

/// parent += sign of each child times its columns of the product, child by child.
template <class Space, class Real, class Field>
struct AddChildren {
  const Passes<Space, Real, Field>& passes;
  const DeviceOperatorSet<Real>& operators;
  int parent, first_child, n_children;

  KOKKOS_INLINE_FUNCTION void operator()(const int row, const Real (&sum)[ColumnGroup<Real>::size]) const {
    Real* const to = passes.source_of(parent) + row;
    for (int k = 0; k < n_children; ++k) {
      const Real sign = operators.sign_of(7 & ~passes.boxes(first_child + k).octant)[row];
      for (int c = 0; c < Field::n_columns; ++c)
        to[c * passes.coefficients.stride] += sign * sum[k * Field::n_columns + c];
    }
  }
};

/// Children to parents of one level (M2M), a few children at once.
template <class Space, class Real, class Field>
void run_m2m(const Space& space, const Passes<Space, Real, Field>& passes, const IndexRange parents,
             const int team_size) {
  using Team = typename Kokkos::TeamPolicy<Space>::member_type;
  using Columns = ColumnGroup<Real>;
  constexpr int at_once = Columns::size / Field::n_columns;
  const int stride = passes.coefficients.stride;
  const std::size_t n_bytes = TeamArray<Space, Columns>::shmem_size(static_cast<std::size_t>(stride));
  const int scratch_level = choose_scratch_level(n_bytes);
  Kokkos::parallel_for(
      "skein::run_m2m", make_team_policy(space, parents.count, team_size, scratch_level, n_bytes),
      KOKKOS_LAMBDA(const Team& team) {
        const int p = parents.first + team.league_rank();
        const Box parent = passes.boxes(p);
        if (parent.is_leaf() || parent.sources.count == 0) return;
        const TeamArray<Space, Columns> in(team.team_scratch(scratch_level), stride);
        const DeviceOperatorSet<Real>& own = passes.levels.sets(parent.level);
        const DeviceOperatorSet<Real>& below = passes.levels.sets(parent.level + 1);
        const int end = parent.first_child + parent.n_children;
        for (int first = parent.first_child; first < end; first += at_once) {
          const int count = math::smaller(at_once, end - first);
          team.team_barrier();  // `in` may be overwritten
          for (int i = team.team_rank(); i < own.to_parent.n_columns; i += team.team_size()) {
            Columns group{};
            for (int k = 0; k < count; ++k) {
              const Box& box = passes.boxes(first + k);
              if (box.sources.count == 0) continue;
              // In the parent's units the child's centre is half a unit off along each axis, and psi half as large.
              Real shift[3];
              for (int c = 0; c < 3; ++c) shift[c] = Real(0.5) * Real(child_side(box.octant, c));
              gather_row<Field>(passes.source_of(first + k) + i, stride, below.sign_of(7 & ~box.octant)[i], Real(0.5),
                                shift, group.value + k * Field::n_columns, 1);
            }
            in(i) = group;
          }
          team.team_barrier();  // `in` is complete
          multiply_by_thread<Columns::size, sizeof(Real) == 8 ? 2 : 4>(
              own.to_parent, team.team_rank(), team.team_size(), GroupedColumns<Real>{in.data()},
              AddChildren<Space, Real, Field>{passes, own, p, first, count});
        }
      });
}

/// Across the V lists (M2L), as many far pairs at once as there is room for their products.
template <class Space, class Real, class Field>
void run_m2l(const Space& space, const Passes<Space, Real, Field>& passes, const IndexRange boxes,
             const int team_size) {
  const auto& products = passes.coefficients.products;
  const int n_pairs = passes.v_list.n_entries;
  const int at_once = static_cast<int>(products.extent(0) / static_cast<std::size_t>(passes.coefficients.box_size));
  for (int begin = 0; begin < n_pairs; begin += at_once) {
    const int end = math::smaller(n_pairs, begin + at_once);
    const TransferProducts<Space, Real, Field> multiply(passes, begin, end, products.data());
    Kokkos::parallel_for(
        "skein::run_m2l",
        make_team_policy(space, multiply.n_teams(), team_size, multiply.scratch_level, multiply.scratch_bytes()),
        multiply);
    Kokkos::parallel_for("skein::add_transfers", make_team_policy(space, boxes.count, team_size, 0, 0),
                         AddTransfers<Space, Real, Field>{passes, boxes.first, begin, end, products.data()});
  }
}

/// From the sources of X lists (P2L).
template <class Space, class Real, class Field>
void run_p2l(const Space& space, const Passes<Space, Real, Field>& passes, const IndexRange boxes,
             const int team_size) {
  using Team = typename Kokkos::TeamPolicy<Space>::member_type;
  const PotentialScratch<Space, Real, Field> scratch(passes.levels);
  const int scratch_level = choose_scratch_level(scratch.bytes());
  const int n_values = scratch.n_values;
  Kokkos::parallel_for(
      "skein::run_p2l", make_team_policy(space, boxes.count, team_size, scratch_level, scratch.bytes()),
      KOKKOS_LAMBDA(const Team& team) {
        const int b = boxes.first + team.league_rank();
        const int first = passes.x_list.first(b), last = passes.x_list.first(b + 1);
        if (first == last) return;
        const TeamArray<Space, Real> potential(team.team_scratch(scratch_level), n_values);
        const TeamArray<Space, FarSource<Real>> tile(team.team_scratch(scratch_level), team_tile);
        const Box box = passes.boxes(b);
        const DeviceOperatorSet<Real>& operators = passes.levels.sets(box.level);
        const double half_width = passes.cube.half_width(box.level);
        for (int i = team.team_rank(); i < n_values; i += team.team_size()) potential(i) = 0;
        for (int k = first; k < last; ++k)
          team_add_potentials(team, passes.nodes, passes.boxes(passes.x_list.entries(k)).sources,
                              passes.cube.center(box), half_width, passes.field.at(half_width), operators,
                              static_cast<Real>(inner_surface), tile.data(), potential.data());
        team.team_barrier();  // potentials are complete
        team_multiply<Field::n_columns>(
            team, operators.to_target, potential.data(), operators.to_target.n_columns,
            AddProduct<Real>{passes.target_of(b), passes.coefficients.stride, operators.sign_of(0)});
      });
}

/// Parents to children of one level (L2L).
template <class Space, class Real, class Field>
void run_l2l(const Space& space, const Passes<Space, Real, Field>& passes, const IndexRange boxes,
             const int team_size) {
  using Team = typename Kokkos::TeamPolicy<Space>::member_type;
  const int stride = passes.coefficients.stride;
  const std::size_t n_bytes =
      TeamArray<Space, Real>::shmem_size(static_cast<std::size_t>(passes.coefficients.box_size));
  const int scratch_level = choose_scratch_level(n_bytes);
  Kokkos::parallel_for(
      "skein::run_l2l", make_team_policy(space, boxes.count, team_size, scratch_level, n_bytes),
      KOKKOS_LAMBDA(const Team& team) {
        const int b = boxes.first + team.league_rank();
        const Box box = passes.boxes(b);
        if (box.targets.count == 0) return;
        const TeamArray<Space, Real> in(team.team_scratch(scratch_level), passes.coefficients.box_size);
        const DeviceOperatorSet<Real>& own = passes.levels.sets(box.level);
        const DeviceOperatorSet<Real>& above = passes.levels.sets(box.level - 1);
        Real shift[3];
        for (int c = 0; c < 3; ++c) shift[c] = Real(-child_side(box.octant, c));
        const int reflected = 7 & ~box.octant;
        team_gather<Field>(team, passes.target_of(box.parent), stride, above.to_child.n_columns,
                           above.sign_of(reflected), Real(2), shift, in.data(), stride);
        team.team_barrier();  // `in` is complete
        team_multiply<Field::n_columns>(team, above.to_child, in.data(), stride,
                                        AddProduct<Real>{passes.target_of(b), stride, own.sign_of(reflected)});
      });
}

}  // namespace

template <class Space, class Real, class Field>
void compute_coefficients_by_teams(const Space& space, const Octree<Space>& tree, const FarOrder<Space>& far,
                                   const DeviceNodes<Space>& nodes, const Field& field,
                                   const DeviceLevels<Space, Real>& levels,
                                   const DeviceCoefficients<Space, Real>& coefficients, const int team_size) {
  Kokkos::deep_copy(space, coefficients.source, Real(0));
  Kokkos::deep_copy(space, coefficients.target, Real(0));
  if (tree.n_levels() <= first_far_level) return;
  const Passes<Space, Real, Field> passes{tree.cube,       tree.boxes, tree.v_list, far.pairs.key,
                                          far.pairs.order, far.place,  tree.x_list, nodes,
                                          field,           levels,     coefficients};
  const int first = tree.level(first_far_level).first;
  const IndexRange boxes{first, tree.n_boxes() - first};
  run_p2m(space, passes, boxes, team_size);
  for (int level = tree.n_levels() - 2; level >= first_far_level; --level)
    run_m2m(space, passes, tree.level(level), team_size);
  if (tree.v_list.n_entries > 0) run_m2l(space, passes, boxes, team_size);
  if (tree.x_list.n_entries > 0) run_p2l(space, passes, boxes, team_size);
  for (int level = first_far_level + 1; level < tree.n_levels(); ++level)
    run_l2l(space, passes, tree.level(level), team_size);
}

#define SKEIN_INSTANTIATE_FOR(S, Real, Field)                                              \
  template void compute_coefficients_by_teams<S, Real, Field>(                             \
      const S&, const Octree<S>&, const FarOrder<S>&, const DeviceNodes<S>&, const Field&, \
      const DeviceLevels<S, Real>&, const DeviceCoefficients<S, Real>&, int);
#define SKEIN_INSTANTIATE(S)                         \
  SKEIN_INSTANTIATE_FOR(S, double, HarmonicField)    \
  SKEIN_INSTANTIATE_FOR(S, float, HarmonicField)     \
  SKEIN_INSTANTIATE_FOR(S, double, StokesletField)   \
  SKEIN_INSTANTIATE_FOR(S, float, StokesletField)    \
  SKEIN_INSTANTIATE_FOR(S, double, RegularizedField) \
  SKEIN_INSTANTIATE_FOR(S, float, RegularizedField)
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
