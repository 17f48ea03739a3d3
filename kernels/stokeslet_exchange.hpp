#pragma once

#include "kernels/simd_transpose.hpp"
#include "kernels/stokeslet_block.hpp"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <utility>

// Pairs of nodes with one blob, both directions at once: S_eps is symmetric, so the weights are computed once.

namespace skein {

using simd::Pack;

inline constexpr int side_nodes = 192;      // of a tile that are in flight at once
inline constexpr int tile_step = 16;        // nodes: whole packs of floats
inline constexpr int undivided_nodes = 48;  // at most block_targets

/// Of n_nodes cut into n_tiles, at multiples of tile_step.
inline IndexRange tile_run(const int tile, const int n_tiles, const int n_nodes) {
  const auto edge = [=](const int t) {
    const auto even = static_cast<int>(static_cast<std::int64_t>(n_nodes) * t / n_tiles);
    return t < n_tiles ? even / tile_step * tile_step : n_nodes;
  };
  return {edge(tile), edge(tile + 1) - edge(tile)};
}

template <class Real>
using Side = NodeTile<Real, side_nodes>;

/// Velocities on a side of nodes, and on each node of one a lane for each of the others it has met.
using SideVelocity = double[3][side_nodes];
template <class Real>
using SideReaction = Pack<Real>[3][side_nodes];

/// Packs of a that meet b at once: b is loaded for all of them, and the reactions on it. In double one pack alone keeps
/// the multipliers busy; of packs of floats two gain a tenth, where there are registers for them.
template <class Real>
inline constexpr int exchanging_packs = std::is_same_v<Real, float>&& simd::bytes == 64 ? 2 : 1;

/// Both directions between some packs of a and all of b, with the weights computed once. The first packs write the
/// reactions on b, the others add to them, in the same order however many meet b at once.
/// @tparam SideA, SideB  a Side, or what has its members (see PackedSide)
template <int packs, bool with_low, bool is_first, class Real, class SideA, class SideB, class Velocity>
void exchange_packs(const SideA& a, const int i, const SideB& b, const Real blob_squared, Velocity& velocity_a,
                    SideReaction<Real>& reaction) {
  constexpr int width = simd::width<Real>;
  Pack<Real> x[packs][3], force[packs][3], u[packs][3] = {};
  [[maybe_unused]] Pack<Real> x_low[packs][3];
  for (int k = 0; k < packs; ++k)
    for (int c = 0; c < 3; ++c) {
      x[k][c] = simd::load_pack(&a.high[c][i + k * width]);
      if constexpr (requires { a.shift; }) x[k][c] += a.shift[c];
      if constexpr (with_low) x_low[k][c] = simd::load_pack(&a.low[c][i + k * width]);
      force[k][c] = simd::load_pack(&a.force[c][i + k * width]);
    }
  for (int j = 0; j < b.n_nodes; ++j) {
    SKEIN_UNROLL
    for (int k = 0; k < packs; ++k) {
      Pack<Real> dx = x[k][0] - b.high[0][j];
      Pack<Real> dy = x[k][1] - b.high[1][j];
      Pack<Real> dz = x[k][2] - b.high[2][j];
      if constexpr (with_low) {
        dx += x_low[k][0] - b.low[0][j];
        dy += x_low[k][1] - b.low[1][j];
        dz += x_low[k][2] - b.low[2][j];
      }
      const auto weight = regularized_stokeslet::weights(dx, dy, dz, blob_squared);
      regularized_stokeslet::add(weight, dx, dy, dz, b.force[0][j], b.force[1][j], b.force[2][j], u[k][0], u[k][1],
                                 u[k][2]);
      // d changes its sign for the reaction, and enters twice.
      if (is_first && k == 0) reaction[0][j] = reaction[1][j] = reaction[2][j] = Pack<Real>{};
      regularized_stokeslet::add(weight, dx, dy, dz, force[k][0], force[k][1], force[k][2], reaction[0][j],
                                 reaction[1][j], reaction[2][j]);
    }
  }
  for (int k = 0; k < packs; ++k)
    for (int c = 0; c < 3; ++c) simd::add_lanes(&velocity_a[c][i + k * width], u[k][c]);
}

/// Both directions between two sides: u += S f, v += S g.
/// @tparam Velocity  SideVelocity, or three pointers to what is added to
template <bool with_low, class Real, class SideA, class SideB, class Velocity>
void exchange(const SideA& a, const SideB& b, const Real blob_squared, Velocity& velocity_a, Velocity& velocity_b) {
  constexpr int width = simd::width<Real>, packs = exchanging_packs<Real>;
  alignas(simd::bytes) SideReaction<Real> reaction;
  for (auto& component : reaction) std::fill(component + b.n_nodes, component + b.n_padded(), Pack<Real>{});
  int i = math::smaller(packs * width, a.n_padded());
  if (i == packs * width)
    exchange_packs<packs, with_low, true>(a, 0, b, blob_squared, velocity_a, reaction);
  else
    exchange_packs<1, with_low, true>(a, 0, b, blob_squared, velocity_a, reaction);
  for (; i + packs * width <= a.n_padded(); i += packs * width)
    exchange_packs<packs, with_low, false>(a, i, b, blob_squared, velocity_a, reaction);
  for (; i < a.n_padded(); i += width) exchange_packs<1, with_low, false>(a, i, b, blob_squared, velocity_a, reaction);
  for (int c = 0; c < 3; ++c)
    for (int j = 0; j < b.n_padded(); j += width)
      simd::add_lanes(&velocity_b[c][j], simd::sum_lanes_of_each<Real>(&reaction[c][j]));
}

inline void add_to(const VectorView<HostSpace>& total, const IndexRange run, const SideVelocity& velocity) {
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < run.count; ++i) total(run.first + i, c) += velocity[c][i];
}

template <class Real>
void load_side(Side<Real>& side, const HostSources& nodes, const IndexRange run, const Vec3 origin) {
  side.template load_positions<HostSpace>(nodes.position, run.first, run.count, origin);
  side.template load_forces<HostSpace>(nodes.force, run.first, nodes.scale);
}

/// Each pair of nodes, one in each run, once.
template <class Real>
void add_between(const HostSources& nodes, const IndexRange one, const IndexRange other,
                 const VectorView<HostSpace>& velocity) {
  const Real blob_squared = static_cast<Real>(nodes.blob(0) * nodes.blob(0));
  Side<Real> a, b;
  for (int i = 0; i < one.count; i += side_nodes) {
    const IndexRange run_a{one.first + i, math::smaller(side_nodes, one.count - i)};
    const Vec3 origin = load(nodes.position, run_a.first + run_a.count / 2);
    load_side(a, nodes, run_a, origin);
    alignas(simd::bytes) SideVelocity velocity_a = {};
    for (int j = 0; j < other.count; j += side_nodes) {
      const IndexRange run_b{other.first + j, math::smaller(side_nodes, other.count - j)};
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
/// @param image  the run itself, or as many nodes that are its images under a matrix that is its own inverse: then each
///               pair of a node and an image once, since that of the other node with the first one's image is its image
template <class Real>
void add_within(const HostSources& nodes, const IndexRange run, const IndexRange image,
                const VectorView<HostSpace>& velocity) {
  if (run.count > undivided_nodes) {
    const int half = math::ceil_div(run.count, 2 * tile_step) * tile_step, rest = run.count - half;
    const IndexRange second{run.first + half, rest}, second_image{image.first + half, rest};
    add_within<Real>(nodes, {run.first, half}, {image.first, half}, velocity);
    add_between<Real>(nodes, {run.first, half}, second_image, velocity);
    add_within<Real>(nodes, second, second_image, velocity);
    return;
  }
  bool given = false;
  const auto whole_run = [&](IndexRange& sources) {
    sources = image;
    return !std::exchange(given, true);
  };
  add_runs_to_targets<Real>(nodes, whole_run, nodes.position, run, velocity);
}

}  // namespace skein
