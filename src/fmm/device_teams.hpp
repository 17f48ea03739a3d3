#pragma once

#include "fmm/device_nodes.hpp"
#include "fmm/device_operators.hpp"
#include "fmm/device_products.hpp"
#include "fmm/laplace.hpp"

// What the teams of the device's passes share. Every number is the work of one thread, in an order that no size of a
// team changes.

namespace skein {

inline constexpr int team_tile = 128;  ///< sources that a team keeps at once

/// Threads of a team: what GPUs like; a host's threads work alone. 0 leaves it to Kokkos.
template <class Space>
inline constexpr int usual_team_size = on_host<Space> ? 1 : 128;

/// The work of teams whose arguments go along with the launch, however many they are: a copy apart would wait for the
/// launch before.
/// @param n_bytes  scratch memory of a team
template <class Space>
auto make_team_policy(const Space& space, const int n_teams, const int team_size, const int scratch_level,
                      const std::size_t n_bytes) {
  using Policy = Kokkos::TeamPolicy<Space>;
  Policy policy = team_size > 0 ? Policy(space, n_teams, team_size) : Policy(space, n_teams, Kokkos::AUTO);
  policy.set_scratch_size(scratch_level, Kokkos::PerTeam(static_cast<int>(n_bytes)));
  return Kokkos::Experimental::require(policy, Kokkos::Experimental::WorkItemProperty::HintLightWeight);
}

/// What a team surely gets of the fast memory, and what leaves room for several teams at once; bytes.
inline constexpr std::size_t sure_scratch = 45000, shared_scratch = 32768;

/// The fast memory up to a limit, else the large one.
inline int choose_scratch_level(const std::size_t n_bytes, const std::size_t limit = shared_scratch) {
  return n_bytes <= limit ? 0 : 1;
}

template <class Space, class Entry>
using TeamArray = Kokkos::View<Entry*, typename Space::scratch_memory_space, Kokkos::MemoryUnmanaged>;

/// to[row] = product.
template <class Real>
struct StoreProduct {
  Real* to;
  int stride;
  template <int n_columns>
  KOKKOS_INLINE_FUNCTION void operator()(const int row, const Real (&sum)[n_columns]) const {
    for (int column = 0; column < n_columns; ++column) to[row + column * stride] = sum[column];
  }
};

/// to[row] += sign[row] product.
template <class Real>
struct AddProduct {
  Real* to;
  int stride;
  const Real* sign;
  template <int n_columns>
  KOKKOS_INLINE_FUNCTION void operator()(const int row, const Real (&sum)[n_columns]) const {
    for (int column = 0; column < n_columns; ++column) to[row + column * stride] += sign[row] * sum[column];
  }
};

/// A times the columns b. b is complete already, and what is written is complete after the next barrier.
template <int n_columns, class Team, class Real, class Write>
KOKKOS_INLINE_FUNCTION void team_multiply(const Team& team, const DeviceMatrix<Real>& a, const Real* b,
                                          const int b_stride, const Write& write) {
  multiply_by_thread<n_columns, 4>(a, team.team_rank(), team.team_size(), StridedColumns<Real>{b, b_stride}, write);
}

/// One row of coefficients with the sign of a reflection. The fourth column of a field that shifts (psi, measured from
/// the box's centre) is moved to the centre of the other box: to = scale * psi + shift . phi.
template <class Field, class Real>
KOKKOS_INLINE_FUNCTION void gather_row(const Real* from, const int stride, const Real sign, const Real scale,
                                       const Real (&shift)[3], Real* to, const int to_stride) {
  for (int column = 0; column < Field::n_columns; ++column) to[column * to_stride] = sign * from[column * stride];
  if constexpr (Field::shifts)
    to[3 * to_stride] =
        sign * (scale * from[3 * stride] + shift[0] * from[0] + shift[1] * from[stride] + shift[2] * from[2 * stride]);
}

/// n rows by the threads of a team.
template <class Field, class Team, class Real>
KOKKOS_INLINE_FUNCTION void team_gather(const Team& team, const Real* from, const int stride, const int n,
                                        const Real* sign, const Real scale, const Real (&shift)[3], Real* to,
                                        const int to_stride) {
  for (int i = team.team_rank(); i < n; i += team.team_size())
    gather_row<Field>(from + i, stride, sign[i], scale, shift, to + i, to_stride);
}

/// potential[plane][n_padded] += field of a run of sources at the surface of that size about a box's centre. Begins and
/// ends with threads that may be apart.
/// @param tile  [team_tile], of the team
template <class Space, class Team, class Real, class Field>
KOKKOS_INLINE_FUNCTION void team_add_potentials(const Team& team, const DeviceNodes<Space>& nodes,
                                                const IndexRange& run, const Vec3 center, const double half_width,
                                                const Field& field, const DeviceOperatorSet<Real>& operators,
                                                const Real size, FarSource<Real>* tile, Real* potential) {
  const double to_units = 1.0 / half_width;
  for (int first = 0; first < run.count; first += team_tile) {
    const int count = math::smaller(team_tile, run.count - first);
    team.team_barrier();  // the tile may be overwritten
    for (int s = team.team_rank(); s < count; s += team.team_size()) {
      const int i = run.first + first + s;
      const Vec3 y = to_units * (load(nodes.position, i) - center);
      const double blob = to_units * nodes.blob(i);
      FarSource<Real>& source = tile[s];
      source.y[0] = static_cast<Real>(y.x);
      source.y[1] = static_cast<Real>(y.y);
      source.y[2] = static_cast<Real>(y.z);
      for (int c = 0; c < 3; ++c) source.force[c] = static_cast<Real>(nodes.force(i, c));
      source.blob_squared = static_cast<Real>(blob * blob);
    }
    team.team_barrier();  // the tile is complete
    // Two points to a thread: what it reads of a source serves both.
    const int n = operators.n_padded, half = math::ceil_div(n, 2);
    for (int p = team.team_rank(); p < half; p += team.team_size()) {
      const int other = math::smaller(p + half, n - 1);
      const Real x[2] = {size * operators.surface_at(p, 0), size * operators.surface_at(other, 0)};
      const Real y[2] = {size * operators.surface_at(p, 1), size * operators.surface_at(other, 1)};
      const Real z[2] = {size * operators.surface_at(p, 2), size * operators.surface_at(other, 2)};
      Real sum[2][Field::n_planes] = {};
      for (int s = 0; s < count; ++s) {
        const FarSource<Real> source = tile[s];
        for (int k = 0; k < 2; ++k) field.add_source(x[k], y[k], z[k], source, sum[k]);
      }
      for (int plane = 0; plane < Field::n_planes; ++plane) {
        potential[plane * n + p] += sum[0][plane];
        if (p + half < n) potential[plane * n + other] += sum[1][plane];
      }
    }
  }
}

}  // namespace skein
