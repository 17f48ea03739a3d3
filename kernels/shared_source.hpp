#pragma once

#include <skein/core/math.hpp>
#include <skein/core/simd.hpp>

#include "kernels/regularized_stokeslet.hpp"

// What teams of threads keep of sources in fast memory that they share, and how a thread sums over it.

namespace skein {

/// Four numbers that a GPU reads at once.
template <class Real>
struct alignas(16) Quad {
  Real x, y, z, w;
};

template <class Real>
struct SharedSource {
  Quad<Real> place;  ///< from the origin of the sum; w: the square of its blob
  Quad<Real> force;  ///< w is not used
};

/// Targets that one thread holds, and their velocities. What it reads of a source serves all of them.
template <class Real, int n_held>
struct HeldTargets {
  Quad<Real> place[n_held];
  Quad<Real> low[n_held];  ///< what `place` misses of a coordinate; read with_low only
  Real velocity[n_held][3];

  /// velocity += that of sources, in their order.
  /// @param low_of  what the sources' places miss, read with_low only
  template <bool with_low>
  SKEIN_INLINE_FUNCTION void add(const SharedSource<Real>* source, const Quad<Real>* low_of, const int count) {
    for (int s = 0; s < count; ++s) {
      const Quad<Real> y = source[s].place, f = source[s].force;
      [[maybe_unused]] Quad<Real> y_low{};
      if constexpr (with_low) y_low = low_of[s];
      SKEIN_UNROLL
      for (int k = 0; k < n_held; ++k) {
        Real dx = place[k].x - y.x, dy = place[k].y - y.y, dz = place[k].z - y.z;
        if constexpr (with_low) {
          dx += low[k].x - y_low.x;
          dy += low[k].y - y_low.y;
          dz += low[k].z - y_low.z;
        }
        const auto weight = regularized_stokeslet::weights(dx, dy, dz, y.w);
        regularized_stokeslet::add(weight, dx, dy, dz, f.x, f.y, f.z, velocity[k][0], velocity[k][1], velocity[k][2]);
      }
    }
  }
};

}  // namespace skein
