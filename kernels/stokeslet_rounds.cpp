#include <skein/arrays/combination.hpp>
#include <skein/core/error.hpp>

#include "kernels/stokeslet_direct.hpp"
#include "kernels/stokeslet_exchange.hpp"
#include "kernels/tournament.hpp"

#include <string>
#include <utility>
#include <vector>

namespace skein {
namespace {

void clear(const VectorView<HostSpace>& velocity, const IndexRange run) {
  for (int c = 0; c < 3; ++c) std::fill_n(&velocity(run.first, c), run.count, 0.0);
}

/// Computes blocks of rounds, each with its halves.
template <class Real>
class RoundSum {
 public:
  RoundSum(const HostSpace& space, const HostSources& nodes, const PairRounds& rounds,
           std::vector<HostVectors>& scratch)
      : space_(space), nodes_(nodes), rounds_(rounds), matches_(list_tournament(rounds.n_tiles)), scratch_(scratch) {}

  void compute(const RoundBlock& block, const VectorView<HostSpace>& velocity) {
    if (block.level == 0) return play(block.index, velocity);
    const RoundBlock first{block.level - 1, 2 * block.index}, second{block.level - 1, 2 * block.index + 1};
    compute(first, velocity);
    if (!rounds_.has_second_half(block)) return;
    const HostVectors other = require(second.level, velocity.extent(0));
    compute(second, other);
    combine<HostSpace>(space_, velocity, {1.0, velocity}, {1.0, other});
  }

 private:
  void play(const int round, const VectorView<HostSpace>& velocity) const {
    const auto run_of = [&](const int tile) { return tile_run(tile, rounds_.n_tiles, velocity.extent_int(0)); };
    using Tasks = Kokkos::RangePolicy<HostSpace, Kokkos::Schedule<Kokkos::Dynamic>>;
    if (round == 0) {
      Kokkos::parallel_for("skein::compute_round_velocity", Tasks(space_, 0, rounds_.n_tiles), [&](const int tile) {
        clear(velocity, run_of(tile));
        add_within<Real>(nodes_, run_of(tile), run_of(tile), velocity);
      });
      return;
    }
    const int n_matches = rounds_.n_tiles / 2;
    const std::pair<int, int>* const pairs = matches_.data() + static_cast<std::ptrdiff_t>(round - 1) * n_matches;
    Kokkos::parallel_for("skein::compute_round_velocity", Tasks(space_, 0, n_matches), [&](const int match) {
      const IndexRange one = run_of(pairs[match].first), other = run_of(pairs[match].second);
      clear(velocity, one);
      clear(velocity, other);
      add_between<Real>(nodes_, one, other, velocity);
    });
  }

  HostVectors require(const int level, const std::size_t n_nodes) {
    const auto l = static_cast<std::size_t>(level);
    if (scratch_.size() <= l) scratch_.resize(l + 1);
    if (scratch_[l].extent(0) != n_nodes)
      scratch_[l] = HostVectors(
          Kokkos::view_alloc(std::string("skein::compute_round_velocity::part"), Kokkos::WithoutInitializing), n_nodes);
    return scratch_[l];
  }

  HostSpace space_;
  const HostSources& nodes_;
  const PairRounds& rounds_;
  std::vector<std::pair<int, int>> matches_;
  std::vector<HostVectors>& scratch_;
};

}  // namespace

void compute_round_velocity(const HostSpace& space, const ConstVectorView<HostSpace>& position,
                            const ConstVectorView<HostSpace>& force, const ConstScalarView<HostSpace>& blob,
                            const PairRounds& rounds, const RoundBlock& block, const VectorView<HostSpace>& velocity,
                            const double viscosity, const Precision precision, std::vector<HostVectors>& scratch) {
  SKEIN_REQUIRE(position.extent(0) == force.extent(0) && position.extent(0) == blob.extent(0) &&
                    position.extent(0) == velocity.extent(0),
                "positions, forces, blobs and velocities differ in number");
  SKEIN_REQUIRE(position.extent_int(0) >= min_symmetric_nodes, "too few nodes for the symmetric sum");
  const HostSources nodes{position, force, blob, regularized_stokeslet::scale(viscosity)};
  with_precision(precision, [&](auto number) {
    RoundSum<decltype(number)>(space, nodes, rounds, scratch).compute(block, velocity);
  });
}

}  // namespace skein
