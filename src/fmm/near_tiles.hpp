#pragma once

#include "fmm/near_matches.hpp"
#include "fmm/sorted_nodes.hpp"
#include "kernels/stokeslet_exchange.hpp"

#include <vector>

namespace skein {

/// Nodes of a tile as the pair loops read them, in the place of a Side: coordinates from the tile's own origin. Nodes
/// behind the last one repeat its position and exert no force.
template <class Real>
struct PackedSide {
  const Real* high[3];
  const Real* force[3];
  int n_nodes;

  int n_padded() const { return (n_nodes + simd::width<Real> - 1) / simd::width<Real> * simd::width<Real>; }
  PackedSide part(const IndexRange run) const {
    return {{high[0] + run.first, high[1] + run.first, high[2] + run.first},
            {force[0] + run.first, force[1] + run.first, force[2] + run.first},
            run.count};
  }
};

/// A tile seen from another one's origin.
template <class Real>
struct ShiftedSide : PackedSide<Real> {
  Real shift[3];  ///< own origin - other origin, length
};

/// The near field of nodes that are sources and targets alike, each pair of nodes once, with one blob for all: made
/// once per sum for all the matches that a tile has, two dozen of them in a cloud.
template <class Real>
class NearTiles {
 public:
  /// velocity[c * n_packed + i] = what node i receives from its leaf and that leaf's partners, in the packed order of
  /// `near`. In single precision coordinates are rounded on the scale of a leaf: single_precision_error allows for it.
  void compute(const SortedNodes<HostSpace>& nodes, const NearMatches& near, const HostScalars& velocity);

  double bytes() const {
    return static_cast<double>(numbers_.size() * sizeof(Real) + origin_.capacity() * sizeof(Vec3));
  }

 private:
  void load(const SortedNodes<HostSpace>& nodes, const NearMatches& near, int tile);
  PackedSide<Real> side(const NearMatches& near, int tile) const;
  ShiftedSide<Real> side_seen_from(const NearMatches& near, int tile, int other) const;

  Kokkos::View<Real*, HostSpace> numbers_;  ///< [6][n_packed]: coordinates, then forces
  std::vector<Vec3> origin_;                ///< per tile
};

}  // namespace skein
