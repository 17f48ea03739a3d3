#include "kernels/stokeslet_direct.hpp"

#include <skein/core/error.hpp>

#include "kernels/simd_transpose.hpp"
#include "kernels/stokeslet_block.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

// Nodes are cut into n_tiles tiles. In round 0 each tile plays alone, in rounds 1 .. n_tiles - 1 a tournament pairs
// every tile with every other, each tile once a round. Threads claim matches in order; a match waits until its tiles
// have finished the rounds before. So no buffers, no atomics on velocities, no barrier between rounds, and every node
// receives its contributions in the order of the rounds whatever the number of threads.

namespace skein {
namespace {

using simd::Pack;

constexpr int side_nodes = 192;      // of a tile that are in flight at once
constexpr int nodes_per_tile = 128;  // aimed at; few nodes make few tiles, many make max_tiles larger ones
constexpr int max_tiles = 64;
constexpr int tile_step = 16;        // nodes: whole packs of floats
constexpr int undivided_nodes = 48;  // at most block_targets

template <class Real>
using Side = NodeTile<Real, side_nodes>;

Run tile_run(const int tile, const int n_tiles, const int n_nodes) {
  const auto edge = [=](const int t) {
    const auto even = static_cast<int>(static_cast<std::int64_t>(n_nodes) * t / n_tiles);
    return t < n_tiles ? even / tile_step * tile_step : n_nodes;
  };
  return {edge(tile), edge(tile + 1) - edge(tile)};
}

/// The tiles of a match by the circle method: the last tile stays, the others rotate.
void paired_tiles(const int round, const int match, const int n_tiles, int& one, int& other) {
  const int n_rotating = n_tiles - 1;
  one = match == 0 ? n_rotating : (round + match) % n_rotating;
  other = match == 0 ? round % n_rotating : (round - match + n_rotating) % n_rotating;
}

/// Which rounds each tile has finished, for all threads to see.
class Rounds {
 public:
  explicit Rounds(const int n_tiles) : finished_(static_cast<std::size_t>(n_tiles)) {}

  void wait_for(const int tile, const int round) const {
    int spins = 0;
    while (finished_[tile].load(std::memory_order_acquire) < round)
      if (++spins > 1000) std::this_thread::yield();
  }
  void finish(const int tile, const int round) { finished_[tile].store(round + 1, std::memory_order_release); }

 private:
  std::vector<std::atomic<int>> finished_;
};

/// Velocities on a side of nodes, and on each node of one a lane for each of the others it has met.
using SideVelocity = double[3][side_nodes];
template <class Real>
using SideReaction = Pack<Real>[3][side_nodes];

/// Both directions between one pack of a and all of b, with the weights computed once. The first pack writes the
/// reactions on b, the others add to them.
template <bool with_low, bool is_first, class Real>
void exchange_pack(const Side<Real>& a, const int i, const Side<Real>& b, const Real blob_squared,
                   SideVelocity& velocity_a, SideReaction<Real>& reaction) {
  const Pack<Real> x = simd::load_pack(&a.high[0][i]), y = simd::load_pack(&a.high[1][i]),
                   z = simd::load_pack(&a.high[2][i]);
  [[maybe_unused]] Pack<Real> x_low, y_low, z_low;
  if constexpr (with_low) {
    x_low = simd::load_pack(&a.low[0][i]);
    y_low = simd::load_pack(&a.low[1][i]);
    z_low = simd::load_pack(&a.low[2][i]);
  }
  const Pack<Real> gx = simd::load_pack(&a.force[0][i]), gy = simd::load_pack(&a.force[1][i]),
                   gz = simd::load_pack(&a.force[2][i]);
  Pack<Real> ux = {}, uy = {}, uz = {};
  for (int j = 0; j < b.n_nodes; ++j) {
    Pack<Real> dx = x - b.high[0][j];
    Pack<Real> dy = y - b.high[1][j];
    Pack<Real> dz = z - b.high[2][j];
    if constexpr (with_low) {
      dx += x_low - b.low[0][j];
      dy += y_low - b.low[1][j];
      dz += z_low - b.low[2][j];
    }
    const auto weight = regularized_stokeslet::weights(dx, dy, dz, blob_squared);
    regularized_stokeslet::add(weight, dx, dy, dz, b.force[0][j], b.force[1][j], b.force[2][j], ux, uy, uz);
    // d changes its sign for the reaction, and enters twice.
    if constexpr (is_first) reaction[0][j] = reaction[1][j] = reaction[2][j] = Pack<Real>{};
    regularized_stokeslet::add(weight, dx, dy, dz, gx, gy, gz, reaction[0][j], reaction[1][j], reaction[2][j]);
  }
  simd::add_lanes(&velocity_a[0][i], ux);
  simd::add_lanes(&velocity_a[1][i], uy);
  simd::add_lanes(&velocity_a[2][i], uz);
}

/// Both directions between two sides: u += S f, v += S g.
template <bool with_low, class Real>
void exchange(const Side<Real>& a, const Side<Real>& b, const Real blob_squared, SideVelocity& velocity_a,
              SideVelocity& velocity_b) {
  constexpr int width = simd::width<Real>;
  alignas(simd::bytes) SideReaction<Real> reaction;
  for (auto& component : reaction) std::fill(component + b.n_nodes, component + b.n_padded(), Pack<Real>{});
  exchange_pack<with_low, true>(a, 0, b, blob_squared, velocity_a, reaction);
  for (int i = width; i < a.n_padded(); i += width)
    exchange_pack<with_low, false>(a, i, b, blob_squared, velocity_a, reaction);
  for (int c = 0; c < 3; ++c)
    for (int j = 0; j < b.n_padded(); j += width)
      simd::add_lanes(&velocity_b[c][j], simd::sum_lanes_of_each<Real>(&reaction[c][j]));
}

void add_to(const VectorView<HostSpace>& total, const Run run, const SideVelocity& velocity) {
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < run.count; ++i) total(run.first + i, c) += velocity[c][i];
}

template <class Real>
void load_side(Side<Real>& side, const HostSources& nodes, const Run run, const Vec3 origin) {
  side.template load_positions<HostSpace>(nodes.position, run.first, run.count, origin);
  side.template load_forces<HostSpace>(nodes.force, run.first, nodes.scale);
}

/// Each pair of nodes, one in each run, once.
template <class Real>
void add_between(const HostSources& nodes, const Run one, const Run other, const VectorView<HostSpace>& velocity) {
  const Real blob_squared = static_cast<Real>(nodes.blob(0) * nodes.blob(0));
  Side<Real> a, b;
  for (int i = 0; i < one.count; i += side_nodes) {
    const Run run_a{one.first + i, math::smaller(side_nodes, one.count - i)};
    const Vec3 origin = load(nodes.position, run_a.first + run_a.count / 2);
    load_side(a, nodes, run_a, origin);
    alignas(simd::bytes) SideVelocity velocity_a = {};
    for (int j = 0; j < other.count; j += side_nodes) {
      const Run run_b{other.first + j, math::smaller(side_nodes, other.count - j)};
      load_side(b, nodes, run_b, origin);
      alignas(simd::bytes) SideVelocity velocity_b = {};
      if (needs_low_parts(a, b, static_cast<double>(blob_squared)))
        exchange<Side<Real>::split>(a, b, blob_squared, velocity_a, velocity_b);
      else
        exchange<false>(a, b, blob_squared, velocity_a, velocity_b);
      add_to(velocity, run_b, velocity_b);
    }
    add_to(velocity, run_a, velocity_a);
  }
}

/// Each pair of nodes inside a run: between its halves, then inside each. Few nodes are summed one direction after the
/// other.
template <class Real>
void add_within(const HostSources& nodes, const Run run, const VectorView<HostSpace>& velocity) {
  if (run.count > undivided_nodes) {
    const int half = math::ceil_div(run.count, 2 * tile_step) * tile_step;
    const Run first{run.first, half}, second{run.first + half, run.count - half};
    add_within<Real>(nodes, first, velocity);
    add_between<Real>(nodes, first, second, velocity);
    add_within<Real>(nodes, second, velocity);
    return;
  }
  bool given = false;
  const auto whole_run = [&](Run& sources) {
    sources = run;
    return !std::exchange(given, true);
  };
  add_runs_to_targets<Real>(nodes, whole_run, nodes.position, run, velocity);
}

template <class Real>
void add_symmetric(const HostSpace& space, const HostSources& nodes, const VectorView<HostSpace>& velocity) {
  const int n_nodes = nodes.position.extent_int(0);
  const int n_tiles = math::smaller(max_tiles, n_nodes / nodes_per_tile / 2 * 2);
  const int n_matches = n_tiles / 2;
  const int n_tasks = n_tiles + (n_tiles - 1) * n_matches;
  Rounds rounds(n_tiles);
  std::atomic<int> next_task{0};
  Rounds* const shared_rounds = &rounds;
  std::atomic<int>* const shared_next = &next_task;

  const auto play = [=](const int task) {
    if (task < n_tiles) {
      add_within<Real>(nodes, tile_run(task, n_tiles, n_nodes), velocity);
      shared_rounds->finish(task, 0);
      return;
    }
    const int round = 1 + (task - n_tiles) / n_matches;
    int one, other;
    paired_tiles(round, (task - n_tiles) % n_matches, n_tiles, one, other);
    shared_rounds->wait_for(one, round);
    shared_rounds->wait_for(other, round);
    add_between<Real>(nodes, tile_run(one, n_tiles, n_nodes), tile_run(other, n_tiles, n_nodes), velocity);
    shared_rounds->finish(one, round);
    shared_rounds->finish(other, round);
  };
  Kokkos::parallel_for("skein::add_symmetric_stokeslet_velocity",
                       Kokkos::RangePolicy<HostSpace>(space, 0, space.concurrency()), [=](int) {
                         for (int task = shared_next->fetch_add(1); task < n_tasks; task = shared_next->fetch_add(1))
                           play(task);
                       });
}

}  // namespace

void add_symmetric_stokeslet_velocity(const HostSpace& space, const ConstVectorView<HostSpace>& position,
                                      const ConstVectorView<HostSpace>& force, const ConstScalarView<HostSpace>& blob,
                                      const VectorView<HostSpace>& velocity, const double viscosity,
                                      const PairPrecision precision) {
  SKEIN_REQUIRE(position.extent(0) == force.extent(0) && position.extent(0) == blob.extent(0) &&
                    position.extent(0) == velocity.extent(0),
                "positions, forces, blobs and velocities differ in number");
  SKEIN_REQUIRE(position.extent_int(0) >= min_symmetric_nodes, "too few nodes for the symmetric sum");
  const HostSources nodes{position, force, blob, regularized_stokeslet::scale(viscosity)};
  if (precision == PairPrecision::in_double)
    add_symmetric<double>(space, nodes, velocity);
  else
    add_symmetric<float>(space, nodes, velocity);
}

}  // namespace skein
