#include "fmm/device_translations.hpp"

namespace skein {
namespace {

/// What a pass needs, by value for kernels.
template <class Space, class Real, class Field>
struct Passes {
  OctreeCube cube;
  Kokkos::View<const Box*, Space> boxes;
  DeviceLists<FarPair, Space> v_list;
  DeviceLists<int, Space> x_list;
  DeviceNodes<Space> nodes;
  Field field;
  DeviceLevels<Space, Real> levels;
  DeviceCoefficients<Space, Real> coefficients;

  KOKKOS_INLINE_FUNCTION Real* source_of(const int b) const {
    return coefficients.source.data() + static_cast<std::ptrdiff_t>(b) * coefficients.box_size;
  }
  KOKKOS_INLINE_FUNCTION Real* target_of(const int b) const {
    return coefficients.target.data() + static_cast<std::ptrdiff_t>(b) * coefficients.box_size;
  }
};

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

/// Children to parents of one level (M2M).
template <class Space, class Real, class Field>
void run_m2m(const Space& space, const Passes<Space, Real, Field>& passes, const IndexRange parents,
             const int team_size) {
  using Team = typename Kokkos::TeamPolicy<Space>::member_type;
  const int stride = passes.coefficients.stride;
  const std::size_t n_bytes =
      TeamArray<Space, Real>::shmem_size(static_cast<std::size_t>(passes.coefficients.box_size));
  const int scratch_level = choose_scratch_level(n_bytes);
  Kokkos::parallel_for(
      "skein::run_m2m", make_team_policy(space, parents.count, team_size, scratch_level, n_bytes),
      KOKKOS_LAMBDA(const Team& team) {
        const int p = parents.first + team.league_rank();
        const Box parent = passes.boxes(p);
        if (parent.is_leaf() || parent.sources.count == 0) return;
        const TeamArray<Space, Real> in(team.team_scratch(scratch_level), passes.coefficients.box_size);
        const DeviceOperatorSet<Real>& own = passes.levels.sets(parent.level);
        const DeviceOperatorSet<Real>& below = passes.levels.sets(parent.level + 1);
        for (int child = parent.first_child; child < parent.first_child + parent.n_children; ++child) {
          const Box& box = passes.boxes(child);
          if (box.sources.count == 0) continue;
          // In the parent's units the child's centre is half a unit off along each axis, and psi half as large.
          Real shift[3];
          for (int c = 0; c < 3; ++c) shift[c] = Real(0.5) * Real(child_side(box.octant, c));
          const int reflected = 7 & ~box.octant;
          team.team_barrier();  // `in` may be overwritten
          team_gather<Field>(team, passes.source_of(child), stride, own.to_parent.n_columns, below.sign_of(reflected),
                             Real(0.5), shift, in.data(), stride);
          team.team_barrier();  // `in` is complete
          team_multiply<Field::n_columns>(team, own.to_parent, in.data(), stride,
                                          AddProduct<Real>{passes.source_of(p), stride, own.sign_of(reflected)});
        }
      });
}

/// Across the V lists (M2L).
template <class Space, class Real, class Field>
void run_m2l(const Space& space, const Passes<Space, Real, Field>& passes, const IndexRange boxes,
             const int team_size) {
  using Team = typename Kokkos::TeamPolicy<Space>::member_type;
  const int stride = passes.coefficients.stride;
  const std::size_t n_bytes =
      2 * TeamArray<Space, Real>::shmem_size(static_cast<std::size_t>(passes.coefficients.box_size));
  const int scratch_level = choose_scratch_level(n_bytes);
  Kokkos::parallel_for(
      "skein::run_m2l", make_team_policy(space, boxes.count, team_size, scratch_level, n_bytes),
      KOKKOS_LAMBDA(const Team& team) {
        const int b = boxes.first + team.league_rank();
        const int first = passes.v_list.first(b), last = passes.v_list.first(b + 1);
        if (first == last) return;
        const TeamArray<Space, Real> in(team.team_scratch(scratch_level), passes.coefficients.box_size);
        const TeamArray<Space, Real> middle(team.team_scratch(scratch_level), passes.coefficients.box_size);
        const DeviceOperatorSet<Real>& operators = passes.levels.sets(passes.boxes(b).level);
        for (int k = first; k < last; ++k) {
          const FarPair pair = passes.v_list.entries(k);
          const int index = transfer_index(pair.transfer), reflected = reflected_axes(pair.transfer);
          const DeviceMatrix<Real> last_factor = operators.transfer_last[index];
          const DeviceMatrix<Real> first_factor = operators.transfer_first[index];
          const bool is_factored = first_factor.n_columns > 0;
          Real shift[3];
          for (int c = 0; c < 3; ++c) shift[c] = Real(2 * pair.transfer[c]);
          const AddProduct<Real> add{passes.target_of(b), stride, operators.sign_of(reflected)};
          team.team_barrier();  // `in` may be overwritten
          team_gather<Field>(team, passes.source_of(pair.source), stride,
                             is_factored ? first_factor.n_columns : last_factor.n_columns, operators.sign_of(reflected),
                             Real(1), shift, in.data(), stride);
          team.team_barrier();  // `in` is complete
          if (is_factored) {
            team_multiply<Field::n_columns>(team, first_factor, in.data(), stride,
                                            StoreProduct<Real>{middle.data(), stride});
            team.team_barrier();  // `middle` is complete
            team_multiply<Field::n_columns>(team, last_factor, middle.data(), stride, add);
          } else {
            team_multiply<Field::n_columns>(team, last_factor, in.data(), stride, add);
          }
        }
      });
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
void compute_coefficients_by_teams(const Space& space, const DeviceOctree<Space>& tree, const DeviceNodes<Space>& nodes,
                                   const Field& field, const DeviceLevels<Space, Real>& levels,
                                   const DeviceCoefficients<Space, Real>& coefficients, const int team_size) {
  Kokkos::deep_copy(space, coefficients.source, Real(0));
  Kokkos::deep_copy(space, coefficients.target, Real(0));
  if (tree.n_levels() <= first_far_level) return;
  const Passes<Space, Real, Field> passes{tree.cube, tree.boxes, tree.v_list, tree.x_list,
                                          nodes,     field,      levels,      coefficients};
  const int first = tree.level(first_far_level).first;
  const IndexRange boxes{first, tree.n_boxes() - first};
  run_p2m(space, passes, boxes, team_size);
  for (int level = tree.n_levels() - 2; level >= first_far_level; --level)
    run_m2m(space, passes, tree.level(level), team_size);
  run_m2l(space, passes, boxes, team_size);
  if (tree.x_list.n_entries > 0) run_p2l(space, passes, boxes, team_size);
  for (int level = first_far_level + 1; level < tree.n_levels(); ++level)
    run_l2l(space, passes, tree.level(level), team_size);
}

#define SKEIN_INSTANTIATE_FOR(S, Real, Field)                                                                          \
  template void compute_coefficients_by_teams<S, Real, Field>(const S&, const DeviceOctree<S>&, const DeviceNodes<S>&, \
                                                              const Field&, const DeviceLevels<S, Real>&,              \
                                                              const DeviceCoefficients<S, Real>&, int);
#define SKEIN_INSTANTIATE(S)                         \
  SKEIN_INSTANTIATE_FOR(S, double, HarmonicField)    \
  SKEIN_INSTANTIATE_FOR(S, float, HarmonicField)     \
  SKEIN_INSTANTIATE_FOR(S, double, StokesletField)   \
  SKEIN_INSTANTIATE_FOR(S, float, StokesletField)    \
  SKEIN_INSTANTIATE_FOR(S, double, RegularizedField) \
  SKEIN_INSTANTIATE_FOR(S, float, RegularizedField)
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
