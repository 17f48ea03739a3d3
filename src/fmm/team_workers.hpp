#pragma once

#include "fmm/box_sums.hpp"
#include "fmm/team_products.hpp"

#include <string>

// How teams of a device's threads work through the boxes of a tree: a team has one box, a thread some surface points or
// rows of a matrix. Every number is the work of one thread, in an order that no size of a team changes.

namespace skein {

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

/// Columns of some pairs of boxes side by side, of which a thread multiplies all by some rows of an operator.
template <class Team, class Real, class Field, int most_pairs>
class TeamBatch {
 public:
  using Columns = ColumnGroup<Real, most_pairs * Field::n_columns>;

  KOKKOS_INLINE_FUNCTION TeamBatch(const Team& team, Columns* columns) : team_(team), columns_(columns) {}
  KOKKOS_INLINE_FUNCTION bool is_full() const { return n_pairs_ == most_pairs; }

  KOKKOS_INLINE_FUNCTION void add(const Real* from, const int from_stride, const int n_in, const Real* sign_in,
                                  const Real scale, const Real (&shift)[3], Real* to, const Real* sign_out) {
    if (n_pairs_ == 0) team_.team_barrier();  // columns may be overwritten
    for (int i = team_.team_rank(); i < n_in; i += team_.team_size()) {
      Columns& row = columns_[i];
      if (n_pairs_ == 0) row = Columns{};
      gather_row<Field>(from + i, from_stride, sign_in[i], scale, shift, row.value + n_pairs_ * Field::n_columns, 1);
    }
    to_[n_pairs_] = to;
    sign_out_[n_pairs_++] = sign_out;
  }

  KOKKOS_INLINE_FUNCTION void apply(const Matrix<Real>& matrix, const int to_stride) {
    if (n_pairs_ == 0) return;
    team_.team_barrier();  // columns are complete
    multiply_by_thread<Columns::size, sizeof(Real) == 8 ? 2 : 4>(
        matrix, team_.team_rank(), team_.team_size(), GroupedColumns<Columns>{columns_}, AddToPairs{*this, to_stride});
    n_pairs_ = 0;
  }

 private:
  struct AddToPairs {
    const TeamBatch& batch;
    int stride;
    KOKKOS_INLINE_FUNCTION void operator()(const int row, const Real (&sum)[Columns::size]) const {
      for (int k = 0; k < batch.n_pairs_; ++k)
        for (int c = 0; c < Field::n_columns; ++c)
          batch.to_[k][row + c * stride] += batch.sign_out_[k][row] * sum[k * Field::n_columns + c];
    }
  };

  const Team& team_;
  Columns* columns_;
  Real* to_[most_pairs];
  const Real* sign_out_[most_pairs];
  int n_pairs_ = 0;
};

template <class Space>
struct TeamWorker {
  using Team = typename Kokkos::TeamPolicy<Space>::member_type;
  const Team& team;
  int scratch_level;

  KOKKOS_INLINE_FUNCTION int rank() const { return team.team_rank(); }
  KOKKOS_INLINE_FUNCTION int size() const { return team.team_size(); }
  KOKKOS_INLINE_FUNCTION void barrier() const { team.team_barrier(); }

  template <class Entry>
  KOKKOS_INLINE_FUNCTION TeamArray<Space, Entry> array(const int n) const {
    return TeamArray<Space, Entry>(team.team_scratch(scratch_level), n);
  }
  template <class Real, class Field, int most_pairs>
  KOKKOS_INLINE_FUNCTION TeamBatch<Team, Real, Field, most_pairs> batch(const int n_in, int /*n_out*/) const {
    using Batch = TeamBatch<Team, Real, Field, most_pairs>;
    return Batch(team, array<typename Batch::Columns>(n_in).data());
  }

  template <int n_columns, class Real, class Write>
  KOKKOS_INLINE_FUNCTION void multiply(const Matrix<Real>& a, const Real* b, const int b_stride,
                                       const Write& write) const {
    multiply_by_thread<n_columns, 4>(a, rank(), size(), StridedColumns<Real>{b, b_stride}, write);
  }

  /// potential[plane][n_padded] += field of a run of sources at the surface of that size about a box's centre. Begins
  /// and ends with threads that may be apart.
  /// @param tile  [source_tile], of the team
  template <class Real, class Field>
  KOKKOS_INLINE_FUNCTION void add_potentials(const SortedNodes<Space>& nodes, const IndexRange& run, const Vec3 center,
                                             const double half_width, const Field& field,
                                             const LevelOperators<Real>& operators, const Real size,
                                             FarSource<Real>* tile, Real* potential) const {
    for (int first = 0; first < run.count; first += source_tile) {
      const int count = math::smaller(source_tile, run.count - first);
      barrier();  // the tile may be overwritten
      for (int s = rank(); s < count; s += this->size())
        tile[s] = load_far_source<Space, Real>(nodes, run.first + first + s, center, 1.0 / half_width);
      barrier();  // the tile is complete
      // Two points to a thread: what it reads of a source serves both.
      const int n = operators.n_padded, half = math::ceil_div(n, 2);
      for (int p = rank(); p < half; p += this->size()) {
        const int place[2] = {p, math::smaller(p + half, n - 1)};
        Real x[2][3], sum[2][Field::n_planes] = {};
        for (int k = 0; k < 2; ++k)
          for (int c = 0; c < 3; ++c) x[k][c] = size * operators.surface_at(place[k], c);
        add_sources(field, tile, count, x, sum);
        for (int plane = 0; plane < Field::n_planes; ++plane) {
          potential[plane * n + p] += sum[0][plane];
          if (p + half < n) potential[plane * n + p + half] += sum[1][plane];
        }
      }
    }
  }
};

/// A box to each team.
template <class Space, class Work>
struct BoxKernel {
  Work work;
  int first_box, scratch_level;
  KOKKOS_INLINE_FUNCTION void operator()(const typename TeamWorker<Space>::Team& team) const {
    work(TeamWorker<Space>{team, scratch_level}, IndexRange{first_box + team.league_rank(), 1});
  }
};

/// What the passes need of scratch memory, for Work::scratch_bytes.
template <class Space>
struct TeamScratch {
  template <class Entry>
  static std::size_t array_bytes(const int n) {
    return TeamArray<Space, Entry>::shmem_size(static_cast<std::size_t>(n));
  }
  template <class Real, class Field, int most_pairs>
  static std::size_t batch_bytes(const int n) {
    return array_bytes<ColumnGroup<Real, most_pairs * Field::n_columns>>(n);
  }
};

template <class Space, class Work>
void for_boxes_by_teams(const Space& space, const std::string& label, const IndexRange boxes, const int team_size,
                        const Work& work) {
  if (boxes.count == 0) return;
  const std::size_t n_bytes = work.template scratch_bytes<TeamScratch<Space>>();
  const int scratch_level = choose_scratch_level(n_bytes);
  Kokkos::parallel_for(label, make_team_policy(space, boxes.count, team_size, scratch_level, n_bytes),
                       BoxKernel<Space, Work>{work, boxes.first, scratch_level});
}

}  // namespace skein
