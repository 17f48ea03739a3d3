#include "fmm/near_tiles.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

namespace skein {
namespace {

/// Where three components of velocities are added to.
using VelocityPlace = double* [3];

/// Each ordered pair of few nodes of a tile, one direction after the other.
template <class Real>
void add_ordered_pairs(const PackedSide<Real>& side, const Real blob_squared, VelocityPlace& velocity) {
  for (int i = 0; i < side.n_padded(); i += simd::width<Real>) {
    const Pack<Real> x = simd::load_pack(side.high[0] + i), y = simd::load_pack(side.high[1] + i),
                     z = simd::load_pack(side.high[2] + i);
    Pack<Real> u[3] = {};
    for (int j = 0; j < side.n_nodes; ++j) {
      const Pack<Real> dx = x - side.high[0][j], dy = y - side.high[1][j], dz = z - side.high[2][j];
      const auto weight = regularized_stokeslet::weights(dx, dy, dz, blob_squared);
      regularized_stokeslet::add(weight, dx, dy, dz, side.force[0][j], side.force[1][j], side.force[2][j], u[0], u[1],
                                 u[2]);
    }
    for (int c = 0; c < 3; ++c) simd::add_lanes(velocity[c] + i, u[c]);
  }
}

/// Each pair of nodes of a tile: between its halves, then inside each.
template <class Real>
void exchange_within(const PackedSide<Real>& side, const Real blob_squared, VelocityPlace& velocity) {
  if (side.n_nodes <= undivided_nodes) return add_ordered_pairs(side, blob_squared, velocity);
  const int half = math::ceil_div(side.n_nodes, 2 * tile_step) * tile_step;
  const PackedSide<Real> first = side.part({0, half}), second = side.part({half, side.n_nodes - half});
  VelocityPlace of_second = {velocity[0] + half, velocity[1] + half, velocity[2] + half};
  exchange_within(first, blob_squared, velocity);
  exchange<false>(first, second, blob_squared, velocity, of_second);
  exchange_within(second, blob_squared, of_second);
}

}  // namespace

template <class Real>
void NearTiles<Real>::load(const SortedNodes<HostSpace>& nodes, const NearMatches& near, const int tile) {
  const auto t = static_cast<std::size_t>(tile);
  const IndexRange run = near.tiles[t];
  const int first = near.packed_first[t], last = near.packed_first[t + 1];
  origin_[t] = skein::load(nodes.position, run.first + run.count / 2);
  const double origin[3] = {origin_[t].x, origin_[t].y, origin_[t].z};
  for (int c = 0; c < 3; ++c) {
    const double* position = &nodes.position(run.first, c);
    const double* force = &nodes.force(run.first, c);
    Real* coordinate = &numbers_(static_cast<std::ptrdiff_t>(c) * near.n_packed() + first);
    Real* strength = &numbers_(static_cast<std::ptrdiff_t>(c + 3) * near.n_packed() + first);
    for (int i = 0; i < run.count; ++i) coordinate[i] = static_cast<Real>(position[i] - origin[c]);
    for (int i = 0; i < run.count; ++i) strength[i] = static_cast<Real>(force[i]);
    for (int i = run.count; i < last - first; ++i) {
      coordinate[i] = coordinate[run.count - 1];
      strength[i] = Real(0);
    }
  }
}

template <class Real>
PackedSide<Real> NearTiles<Real>::side(const NearMatches& near, const int tile) const {
  const auto t = static_cast<std::size_t>(tile);
  PackedSide<Real> side;
  for (int c = 0; c < 3; ++c) {
    side.high[c] = &numbers_(static_cast<std::ptrdiff_t>(c) * near.n_packed() + near.packed_first[t]);
    side.force[c] = &numbers_(static_cast<std::ptrdiff_t>(c + 3) * near.n_packed() + near.packed_first[t]);
  }
  side.n_nodes = near.tiles[t].count;
  return side;
}

template <class Real>
ShiftedSide<Real> NearTiles<Real>::side_seen_from(const NearMatches& near, const int tile, const int other) const {
  const Vec3 shift = origin_[static_cast<std::size_t>(tile)] - origin_[static_cast<std::size_t>(other)];
  return {side(near, tile), {static_cast<Real>(shift.x), static_cast<Real>(shift.y), static_cast<Real>(shift.z)}};
}

template <class Real>
void NearTiles<Real>::compute(const SortedNodes<HostSpace>& nodes, const NearMatches& near,
                              const HostScalars& velocity) {
  const int n_tiles = static_cast<int>(near.tiles.size());
  if (numbers_.extent_int(0) != 6 * near.n_packed())
    numbers_ = Kokkos::View<Real*, HostSpace>(
        Kokkos::view_alloc(std::string("skein::near_tiles::numbers"), Kokkos::WithoutInitializing),
        6 * near.n_packed());
  origin_.resize(near.tiles.size());
  Kokkos::parallel_for("skein::load_near_tiles",
                       Kokkos::RangePolicy<HostSpace>(HostSpace(), 0, static_cast<int>(near.met.size())),
                       [&](const int i) {
                         const int tile = near.met[static_cast<std::size_t>(i)];
                         load(nodes, near, tile);
                         const int first = near.packed_first[static_cast<std::size_t>(tile)];
                         const int n = near.packed_first[static_cast<std::size_t>(tile) + 1] - first;
                         for (int c = 0; c < 3; ++c)
                           std::fill_n(&velocity(static_cast<std::ptrdiff_t>(c) * near.n_packed() + first), n, 0.0);
                       });
  const Real blob_squared = static_cast<Real>(nodes.blob(0) * nodes.blob(0));
  const auto place_of = [&](const int tile, VelocityPlace& place) {
    for (int c = 0; c < 3; ++c)
      place[c] = &velocity(static_cast<std::ptrdiff_t>(c) * near.n_packed() +
                           near.packed_first[static_cast<std::size_t>(tile)]);
  };
  play_in_order("skein::compute_near_velocities", HostSpace(), n_tiles, near.matches, [&](const Match& match) {
    VelocityPlace of_one, of_other;
    place_of(match.one, of_one);
    if (match.one == match.other) return exchange_within(side(near, match.one), blob_squared, of_one);
    place_of(match.other, of_other);
    exchange<false>(side_seen_from(near, match.one, match.other), side(near, match.other), blob_squared, of_one,
                    of_other);
  });
}

template class NearTiles<double>;
template class NearTiles<float>;

}  // namespace skein
