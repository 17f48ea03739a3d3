#pragma once

#include "fmm/passes.hpp"
#include "fmm/team_workers.hpp"
#include "fmm/tree_tasks.hpp"

// The transfers across V lists on a device: far pairs by operator, a few at once, then the sum of each box.

namespace skein {

/// Far pairs [begin, end) in the order of their operators, a batch to a team: products(pair - begin) = operator times
/// the coefficients of its source. What is read of an operator serves the columns of a whole batch: a strip of
/// neighbouring threads takes a group of columns, a thread rows of it. A number is a sum over the columns of the
/// operator, in their order, whatever the team and the batch.
template <class Space, class Real, class Field>
struct TransferProducts {
  using Team = typename Kokkos::TeamPolicy<Space>::member_type;
  using Columns = ColumnGroup<Real, 8>;
  static constexpr int group_pairs = Columns::size / Field::n_columns;  ///< of a strip
  static constexpr int most_strips = 4;
  static constexpr int most_rows = on_host<Space> ? 1 : sizeof(Real) == 8 ? 2 : 4;  ///< of a thread at once
  static constexpr int enough_teams = on_host<Space> ? 4 : 2000;                    ///< to keep a device busy

  Passes<Space, Real, Field> passes;
  FarOrder<Space> far;
  int begin, end;
  Real* products;  ///< [end - begin][box_size]
  int n_strips, scratch_level;

  TransferProducts(const Passes<Space, Real, Field>& of, const FarOrder<Space>& order, const int first, const int last,
                   Real* to)
      : passes(of), far(order), begin(first), end(last), products(to) {
    for (n_strips = most_strips; n_strips > 1; n_strips /= 2)
      if ((end - begin) / batch_pairs() >= enough_teams && choose_scratch_level(scratch_bytes(), sure_scratch) == 0)
        break;
    scratch_level = choose_scratch_level(scratch_bytes(), sure_scratch);
  }

  int batch_pairs() const { return n_strips * group_pairs; }
  int n_teams() const { return math::ceil_div(end - begin, batch_pairs()); }
  /// What strips read, and what stands between two thin factors.
  std::size_t scratch_bytes() const {
    return TeamArray<Space, Columns>::shmem_size(static_cast<std::size_t>(n_strips * passes.coefficients.stride)) +
           TeamArray<Space, Columns>::shmem_size(static_cast<std::size_t>(n_strips * passes.levels.max_middle));
  }

  KOKKOS_INLINE_FUNCTION void operator()(const Team& team) const {
    const int n_values = passes.coefficients.stride, n_middle = passes.levels.max_middle;
    const TeamArray<Space, Columns> in(team.team_scratch(scratch_level), n_strips * n_values);
    const TeamArray<Space, Columns> middle(team.team_scratch(scratch_level), n_strips * n_middle);
    // A team that has fewer threads than strips takes them one after the other.
    const int n_beside = math::smaller(n_strips, team.team_size());
    const int n_threads = team.team_size() / n_beside;  // of a strip
    const int first_strip = team.team_rank() / n_threads, lane = team.team_rank() % n_threads;
    const int n = group_pairs * n_strips;
    const int first = begin + team.league_rank() * n, last = math::smaller(end, first + n);
    for (int from = first; from < last;) {
      const std::uint64_t key = far.pairs.key(from);
      int to = from + 1;
      while (to < last && far.pairs.key(to) == key) ++to;
      const LevelOperators<Real>& operators = passes.levels.sets(static_cast<int>(key / n_transfers));
      const int index = static_cast<int>(key % n_transfers);
      const Matrix<Real> last_factor = operators.transfer_last[index];
      const Matrix<Real> first_factor = operators.transfer_first[index];
      const bool is_factored = first_factor.n_columns > 0;
      team.team_barrier();  // what was read may be overwritten
      for (int strip = first_strip; strip < n_strips; strip += n_beside)
        gather(operators, from + strip * group_pairs, to, is_factored ? first_factor.n_columns : last_factor.n_columns,
               lane, n_threads, in.data() + strip * n_values);
      team.team_barrier();  // it is complete
      if (is_factored) {
        for (int strip = first_strip; strip < n_strips; strip += n_beside)
          if (from + strip * group_pairs < to)
            multiply(first_factor, in.data() + strip * n_values, lane, n_threads,
                     StoreColumns{middle.data() + strip * n_middle});
        team.team_barrier();  // what stands between the factors is complete
      }
      for (int strip = first_strip; strip < n_strips; strip += n_beside)
        if (from + strip * group_pairs < to)
          multiply(last_factor, is_factored ? middle.data() + strip * n_middle : in.data() + strip * n_values, lane,
                   n_threads, StoreProducts{*this, from + strip * group_pairs, to});
      from = to;
    }
  }

 private:
  /// The columns of pairs [from, to), as many as a group has; zero where there are fewer.
  KOKKOS_INLINE_FUNCTION void gather(const LevelOperators<Real>& operators, const int from, const int to, const int n,
                                     const int lane, const int n_threads, Columns* columns) const {
    if (from >= to) return;
    for (int i = lane; i < n; i += n_threads) {
      Columns group{};
      for (int k = 0; k < math::smaller(group_pairs, to - from); ++k) {
        const FarPair pair = passes.v_list.entries(far.pairs.order(from + k));
        const Real shift[3] = {Real(2 * pair.transfer[0]), Real(2 * pair.transfer[1]), Real(2 * pair.transfer[2])};
        gather_row<Field>(passes.source_of(pair.source) + i, passes.coefficients.stride,
                          operators.sign_of(reflected_axes(pair.transfer))[i], Real(1), shift,
                          group.value + k * Field::n_columns, 1);
      }
      columns[i] = group;
    }
  }

  template <class Write>
  KOKKOS_INLINE_FUNCTION static void multiply(const Matrix<Real>& a, const Columns* b, const int lane,
                                              const int n_threads, const Write& write) {
    multiply_by_thread<Columns::size, most_rows>(a, lane, n_threads, GroupedColumns<Columns>{b}, write);
  }

  struct StoreColumns {
    Columns* to;
    KOKKOS_INLINE_FUNCTION void operator()(const int row, const Real (&sum)[Columns::size]) const {
      Columns columns;
      for (int j = 0; j < Columns::size; ++j) columns.value[j] = sum[j];
      to[row] = columns;
    }
  };

  struct StoreProducts {
    const TransferProducts& of;
    int from, to;
    KOKKOS_INLINE_FUNCTION void operator()(const int row, const Real (&sum)[Columns::size]) const {
      const auto& coefficients = of.passes.coefficients;
      for (int k = 0; k < math::smaller(group_pairs, to - from); ++k) {
        Real* const product = of.products + static_cast<std::ptrdiff_t>(from + k - of.begin) * coefficients.box_size;
        for (int c = 0; c < Field::n_columns; ++c)
          product[row + c * coefficients.stride] = sum[k * Field::n_columns + c];
      }
    }
  };
};

/// The coefficients of a target += the products of its far pairs that are in [begin, end), in the order of its list: a
/// team for every box.
template <class Space, class Real, class Field>
struct AddTransfers {
  using Team = typename Kokkos::TeamPolicy<Space>::member_type;

  Passes<Space, Real, Field> passes;
  Kokkos::View<const int*, Space> far_place;
  IndexRange targets;  ///< places in the tree's order: boxes without any of these are left out
  int begin, end;
  const Real* products;

  KOKKOS_INLINE_FUNCTION void operator()(const Team& team) const {
    const int b = team.league_rank();
    const int first = passes.v_list.first(b), last = passes.v_list.first(b + 1);
    if (first == last || !overlap(passes.boxes(b).targets, targets)) return;
    const auto& coefficients = passes.coefficients;
    const LevelOperators<Real>& operators = passes.levels.sets(passes.boxes(b).level);
    for (int row = team.team_rank(); row < operators.rank_padded; row += team.team_size()) {
      Real sum[Field::n_columns] = {};
      for (int k = first; k < last; ++k) {
        const int place = far_place(k);
        if (place < begin || place >= end) continue;
        const Real sign = operators.sign_of(reflected_axes(passes.v_list.entries(k).transfer))[row];
        const Real* const product = products + static_cast<std::ptrdiff_t>(place - begin) * coefficients.box_size + row;
        for (int c = 0; c < Field::n_columns; ++c) sum[c] += sign * product[c * coefficients.stride];
      }
      for (int c = 0; c < Field::n_columns; ++c) passes.target_of(b)[row + c * coefficients.stride] += sum[c];
    }
  }
};

}  // namespace skein
