#pragma once

#include "kernels/simd_transpose.hpp"
#include "kernels/stokeslet_block.hpp"

#include <algorithm>
#include <utility>

// Pairs of nodes with one blob, both directions at once: S_eps is symmetric, so the weights are computed once.

namespace skein {

using simd::Pack;

inline constexpr int side_nodes = 192;      // of a tile that are in flight at once
inline constexpr int tile_step = 16;        // nodes: whole packs of floats
inline constexpr int undivided_nodes = 48;  // at most block_targets

template <class Real>
using Side = NodeTile<Real, side_nodes>;

/// What single precision takes of a coordinate.
enum class Coordinates {
  exact,    ///< both parts, where it matters
  rounded,  ///< the high part: an error of 2^-25 of the distance from the sides' origin is allowed for
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
template <class Real, Coordinates coordinates = Coordinates::exact>
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
      if (coordinates == Coordinates::exact && needs_low_parts(a, b, static_cast<double>(blob_squared)))
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
template <class Real, Coordinates coordinates = Coordinates::exact>
void add_within(const HostSources& nodes, const IndexRange run, const IndexRange image,
                const VectorView<HostSpace>& velocity) {
  if (run.count > undivided_nodes) {
    const int half = math::ceil_div(run.count, 2 * tile_step) * tile_step, rest = run.count - half;
    const IndexRange second{run.first + half, rest}, second_image{image.first + half, rest};
    add_within<Real, coordinates>(nodes, {run.first, half}, {image.first, half}, velocity);
    add_between<Real, coordinates>(nodes, {run.first, half}, second_image, velocity);
    add_within<Real, coordinates>(nodes, second, second_image, velocity);
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
