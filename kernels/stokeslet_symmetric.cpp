#include <skein/core/error.hpp>

#include "kernels/ordered_matches.hpp"
#include "kernels/stokeslet_direct.hpp"
#include "kernels/stokeslet_exchange.hpp"
#include "kernels/tournament.hpp"

#include <vector>

// Nodes are cut into n_tiles tiles. In round 0 each tile plays alone, in rounds 1 .. n_tiles - 1 a tournament pairs
// every tile with every other, each tile once a round.

namespace skein {
namespace {

constexpr int nodes_per_tile = 128;  // aimed at; few nodes make few tiles, many make max_tiles larger ones
constexpr int max_tiles = 64;

std::vector<Match> make_matches(const int n_tiles) {
  std::vector<Match> matches;
  for (int tile = 0; tile < n_tiles; ++tile) matches.push_back({tile, tile});
  for (const auto& [one, other] : list_tournament(n_tiles)) matches.push_back({one, other});
  count_turns(n_tiles, matches);
  return matches;
}

template <class Real>
void add_symmetric(const HostSpace& space, const HostSources& nodes, const VectorView<HostSpace>& velocity) {
  const int n_nodes = nodes.position.extent_int(0);
  const int n_tiles = math::smaller(max_tiles, n_nodes / nodes_per_tile / 2 * 2);
  const auto run_of = [=](const int tile) { return tile_run(tile, n_tiles, n_nodes); };
  play_in_order("skein::add_symmetric_stokeslet_velocity", space, n_tiles, make_matches(n_tiles),
                [&](const Match& match) {
                  if (match.one == match.other)
                    add_within<Real>(nodes, run_of(match.one), run_of(match.one), velocity);
                  else
                    add_between<Real>(nodes, run_of(match.one), run_of(match.other), velocity);
                });
}

}  // namespace

void add_symmetric_stokeslet_velocity(const HostSpace& space, const ConstVectorView<HostSpace>& position,
                                      const ConstVectorView<HostSpace>& force, const ConstScalarView<HostSpace>& blob,
                                      const VectorView<HostSpace>& velocity, const double viscosity,
                                      const Precision precision) {
  SKEIN_REQUIRE(position.extent(0) == force.extent(0) && position.extent(0) == blob.extent(0) &&
                    position.extent(0) == velocity.extent(0),
                "positions, forces, blobs and velocities differ in number");
  SKEIN_REQUIRE(position.extent_int(0) >= min_symmetric_nodes, "too few nodes for the symmetric sum");
  const HostSources nodes{position, force, blob, regularized_stokeslet::scale(viscosity)};
  with_precision(precision, [&](auto number) { add_symmetric<decltype(number)>(space, nodes, velocity); });
}

}  // namespace skein
