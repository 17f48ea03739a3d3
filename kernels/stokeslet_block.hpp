#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/index_range.hpp"
#include "kernels/regularized_stokeslet.hpp"
#include "kernels/stokeslet_tile.hpp"

namespace skein {

/// Sources of a sum on the host; the scale 1 / (8 pi viscosity) goes into the forces.
struct HostSources {
  ConstVectorView<HostSpace> position;
  ConstVectorView<HostSpace> force;
  ConstScalarView<HostSpace> blob;
  double scale;
};

// Targets wait in registers and in the first cache while the sources stream past, tile by tile.
inline constexpr int block_targets = 128;
inline constexpr int tile_sources = 128;
inline constexpr int packs_at_once = 2;  // two independent chains of operations hide the latency of each

template <class Real>
using Block = NodeTile<Real, block_targets>;
template <class Real>
using SourceTile = NodeTile<Real, tile_sources>;

/// Velocities of a block's targets; padding lanes included.
template <class Real>
struct BlockSum {
  alignas(simd::bytes) double velocity[3][Block<Real>::padded];
};

/// sum += velocity at `packs` packs of targets due to one tile.
template <int packs, bool with_low, class Real>
void add_tile(const Block<Real>& targets, const int first, const SourceTile<Real>& sources, BlockSum<Real>& sum) {
  constexpr int width = simd::width<Real>;
  simd::Pack<Real> x[packs], y[packs], z[packs], ux[packs] = {}, uy[packs] = {}, uz[packs] = {};
  [[maybe_unused]] simd::Pack<Real> x_low[packs], y_low[packs], z_low[packs];
  for (int k = 0; k < packs; ++k) {
    x[k] = simd::load_pack(&targets.high[0][first + k * width]);
    y[k] = simd::load_pack(&targets.high[1][first + k * width]);
    z[k] = simd::load_pack(&targets.high[2][first + k * width]);
    if constexpr (with_low) {
      x_low[k] = simd::load_pack(&targets.low[0][first + k * width]);
      y_low[k] = simd::load_pack(&targets.low[1][first + k * width]);
      z_low[k] = simd::load_pack(&targets.low[2][first + k * width]);
    }
  }
  for (int s = 0; s < sources.n_nodes; ++s) {
    const Real fx = sources.force[0][s], fy = sources.force[1][s], fz = sources.force[2][s];
    const Real blob_squared = sources.blob_squared[s];
    SKEIN_UNROLL
    for (int k = 0; k < packs; ++k) {
      simd::Pack<Real> dx = x[k] - sources.high[0][s];
      simd::Pack<Real> dy = y[k] - sources.high[1][s];
      simd::Pack<Real> dz = z[k] - sources.high[2][s];
      if constexpr (with_low) {
        dx += x_low[k] - sources.low[0][s];
        dy += y_low[k] - sources.low[1][s];
        dz += z_low[k] - sources.low[2][s];
      }
      const auto weight = regularized_stokeslet::weights(dx, dy, dz, blob_squared);
      regularized_stokeslet::add(weight, dx, dy, dz, fx, fy, fz, ux[k], uy[k], uz[k]);
    }
  }
  for (int k = 0; k < packs; ++k) {
    simd::add_lanes(&sum.velocity[0][first + k * width], ux[k]);
    simd::add_lanes(&sum.velocity[1][first + k * width], uy[k]);
    simd::add_lanes(&sum.velocity[2][first + k * width], uz[k]);
  }
}

template <bool with_low, class Real>
void add_tile_to_block(const Block<Real>& targets, const SourceTile<Real>& sources, BlockSum<Real>& sum) {
  constexpr int width = simd::width<Real>;
  int first = 0;
  for (; first + packs_at_once * width <= targets.n_padded(); first += packs_at_once * width)
    add_tile<packs_at_once, with_low>(targets, first, sources, sum);
  for (; first < targets.n_padded(); first += width) add_tile<1, with_low>(targets, first, sources, sum);
}

/// sum += velocity at the block's targets due to a run of sources, one direction.
template <class Real>
void add_run_to_block(const HostSources& from, const IndexRange run, const Block<Real>& targets, const Vec3 origin,
                      BlockSum<Real>& sum) {
  SourceTile<Real> sources;
  for (int s = 0; s < run.count; s += tile_sources) {
    const int first = run.first + s;
    sources.template load_positions<HostSpace>(from.position, first, math::smaller(tile_sources, run.count - s),
                                               origin);
    sources.template load_forces<HostSpace>(from.force, first, from.scale);
    sources.template load_blobs<HostSpace>(from.blob, first);
    const Real smallest = *std::min_element(sources.blob_squared, sources.blob_squared + sources.n_nodes);
    if (needs_low_parts(targets, sources, static_cast<double>(smallest)))
      add_tile_to_block<Block<Real>::split>(targets, sources, sum);
    else
      add_tile_to_block<false>(targets, sources, sum);
  }
}

/// velocity of a run of at most block_targets targets += what runs of sources, named by next_run(IndexRange&) until it
/// says false, contribute.
template <class Real, class NextRun>
void add_runs_to_targets(const HostSources& from, const NextRun& next_run, const ConstVectorView<HostSpace>& target,
                         const IndexRange targets, const VectorView<HostSpace>& velocity) {
  const Vec3 origin = load(target, targets.first + targets.count / 2);
  Block<Real> block;
  block.template load_positions<HostSpace>(target, targets.first, targets.count, origin);
  BlockSum<Real> sum = {};
  IndexRange run;
  while (next_run(run)) add_run_to_block(from, run, block, origin, sum);
  for (int t = 0; t < targets.count; ++t)
    for (int c = 0; c < 3; ++c) velocity(targets.first + t, c) += sum.velocity[c][t];
}

}  // namespace skein
