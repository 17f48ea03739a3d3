#pragma once

#include <skein/core/types.hpp>

#include "kernels/simd.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace skein {

/// A few nodes copied from the long arrays into buffers that stay in the first cache, as Reals.
///
/// In single precision a coordinate is a pair: high = float(x - origin), low = float(x - origin - high). The difference
/// (high_t - high_s) + (low_t - low_s) is then as good as one taken in double and rounded. Where no node of two tiles is
/// close to another, `low` does not matter and is left out of the sum.
template <class Real, int capacity>
struct NodeTile {
  static constexpr bool split = std::is_same_v<Real, float>;
  static constexpr int padded = (capacity + simd::width<Real> - 1) / simd::width<Real> * simd::width<Real>;

  alignas(simd::bytes) Real high[3][padded];
  alignas(simd::bytes) Real low[3][split ? padded : 1];
  alignas(simd::bytes) Real force[3][padded];
  alignas(simd::bytes) Real blob_squared[padded];
  int n_nodes = 0;
  double reach = 0.0;    ///< largest |coordinate - origin|
  double nearest = 0.0;  ///< smallest over the nodes of the largest |coordinate - origin|

  int n_padded() const { return (n_nodes + simd::width<Real> - 1) / simd::width<Real> * simd::width<Real>; }

  /// Lanes behind the last node repeat its position: they are computed and thrown away.
  template <class Space>
  void load_positions(const ConstVectorView<Space>& position, const int first, const int count, const Vec3 origin) {
    n_nodes = count;
    const double shift[3] = {origin.x, origin.y, origin.z};
    double farthest[capacity] = {};
    for (int c = 0; c < 3; ++c) {
      const double* from = &position(first, c);
      for (int i = 0; i < count; ++i) {
        const double x = split ? from[i] - shift[c] : from[i];
        high[c][i] = static_cast<Real>(x);
        if constexpr (split) {
          low[c][i] = static_cast<Real>(x - static_cast<double>(high[c][i]));
          farthest[i] = std::max(farthest[i], std::abs(x));
        }
      }
      for (int i = count; i < n_padded(); ++i) {
        high[c][i] = high[c][count - 1];
        if constexpr (split) low[c][i] = low[c][count - 1];
      }
    }
    if constexpr (split) {
      reach = *std::max_element(farthest, farthest + count);
      nearest = *std::min_element(farthest, farthest + count);
    }
  }

  /// Padding lanes exert no force.
  template <class Space>
  void load_forces(const ConstVectorView<Space>& force_of, const int first, const double scale) {
    for (int c = 0; c < 3; ++c) {
      const double* from = &force_of(first, c);
      for (int i = 0; i < n_nodes; ++i) force[c][i] = static_cast<Real>(scale * from[i]);
      for (int i = n_nodes; i < n_padded(); ++i) force[c][i] = Real(0);
    }
  }

  template <class Space>
  void load_blobs(const ConstScalarView<Space>& blob, const int first) {
    for (int i = 0; i < n_nodes; ++i) blob_squared[i] = static_cast<Real>(blob(first + i) * blob(first + i));
  }
};

/// True where the low parts of coordinates matter between targets (which the origin belongs to) and sources.
template <class Targets, class Sources>
bool needs_low_parts(const Targets& targets, const Sources& sources) {
  return Targets::split && sources.nearest < 4.0 * targets.reach;
}

}  // namespace skein
