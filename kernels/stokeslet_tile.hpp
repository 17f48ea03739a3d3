#pragma once

#include <skein/arrays/types.hpp>
#include <skein/core/simd.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace skein {

/// A few nodes copied from the long arrays into buffers that stay in the first cache, as Reals.
///
/// In single precision a coordinate is a pair: high = float(x - origin), low = float(x - origin - high). The difference
/// (high_t - high_s) + (low_t - low_s) is then as good as one taken in double and rounded. Where it makes no difference
/// (needs_low_parts), `low` is left out of the sum.
template <class Real, int capacity>
struct NodeTile {
  static constexpr bool split = std::is_same_v<Real, float>;
  static constexpr int padded = (capacity + simd::width<Real> - 1) / simd::width<Real> * simd::width<Real>;

  alignas(simd::bytes) Real high[3][padded];
  alignas(simd::bytes) Real low[3][split ? padded : 1];
  alignas(simd::bytes) Real force[3][padded];
  alignas(simd::bytes) Real blob_squared[padded];
  int n_nodes = 0;
  double lowest[3], highest[3];  ///< coordinates from the origin, length; only where split

  int n_padded() const { return (n_nodes + simd::width<Real> - 1) / simd::width<Real> * simd::width<Real>; }

  /// Lanes behind the last node repeat its position: they are computed and thrown away.
  template <class Space>
  void load_positions(const ConstVectorView<Space>& position, const int first, const int count, const Vec3 origin) {
    n_nodes = count;
    const double shift[3] = {origin.x, origin.y, origin.z};
    for (int c = 0; c < 3; ++c) {
      const double* from = &position(first, c);
      if constexpr (split) {
        alignas(simd::bytes) double x[padded];
        for (int i = 0; i < count; ++i) x[i] = from[i] - shift[c];
        for (int i = count; i < n_padded(); ++i) x[i] = x[count - 1];
        split_coordinate(x, c);
      } else {
        for (int i = 0; i < count; ++i) high[c][i] = from[i];
        for (int i = count; i < n_padded(); ++i) high[c][i] = from[count - 1];
      }
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

 private:
  void split_coordinate(const double* x, const int c) {
    constexpr int step = simd::width<double>;
    auto smallest = simd::load_pack(x), largest = smallest;
    for (int i = 0; i < n_padded(); i += step) {
      const auto exact = simd::load_pack(x + i);
      const auto rounded = simd::to_single(exact);
      const auto rest = simd::to_single(exact - simd::to_double(rounded));
      std::memcpy(&high[c][i], &rounded, sizeof rounded);
      std::memcpy(&low[c][i], &rest, sizeof rest);
      smallest = simd::smaller_lanes(smallest, exact);
      largest = simd::larger_lanes(largest, exact);
    }
    lowest[c] = simd::smallest_lane(smallest);
    highest[c] = simd::largest_lane(largest);
  }
};

/// True where the low parts of coordinates matter. Without them a coordinate is known to 2^-25 of the farthest node's;
/// the pair formula sees it on the scale of sqrt(r^2 + eps^2), so this must not be far below the farthest coordinate.
/// @param blob_squared  the smallest, length^2
template <class Targets, class Sources>
bool needs_low_parts(const Targets& targets, const Sources& sources, const double blob_squared) {
  if constexpr (!Targets::split) return false;
  constexpr double allowed = 8.0;
  double farthest = 0.0, scale_squared = blob_squared;
  for (int c = 0; c < 3; ++c) {
    farthest = std::max({farthest, std::abs(targets.lowest[c]), std::abs(targets.highest[c]),
                         std::abs(sources.lowest[c]), std::abs(sources.highest[c])});
    const double gap = std::max({0.0, targets.lowest[c] - sources.highest[c], sources.lowest[c] - targets.highest[c]});
    scale_squared += gap * gap;
  }
  return !(farthest * farthest < allowed * allowed * scale_squared);
}

}  // namespace skein
