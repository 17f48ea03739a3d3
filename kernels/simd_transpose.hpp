#pragma once

#include <skein/core/simd.hpp>

#include <cstddef>
#include <utility>

#if defined(__has_builtin) && !defined(__CUDACC__)  // nvcc's front end does not know the builtin
#if __has_builtin(__builtin_shufflevector)
#define SKEIN_HAS_SHUFFLES
#endif
#endif

namespace skein::simd {

#if defined(SKEIN_HAS_SHUFFLES)
namespace detail {

/// Lane of (a, b) that comes to `lane`: of each group of lanes its first half (part 0) or second half (part 1).
template <class Real>
constexpr int lane_from(const int lane, const int group, const int part) {
  const int half = group / 2;
  const int within_pack = lane % (width<Real> / 2);
  const int pack = lane / (width<Real> / 2);
  return pack * width<Real> + within_pack / half * group + part * half + within_pack % half;
}

template <int group, class Real, std::size_t... lane>
inline Pack<Real> fold(const Pack<Real> a, const Pack<Real> b, std::index_sequence<lane...>) {
  return __builtin_shufflevector(a, b, lane_from<Real>(lane, group, 0)...) +
         __builtin_shufflevector(a, b, lane_from<Real>(lane, group, 1)...);
}

/// Lanes summed within groups of `group` lanes, for width / group packs at once: as many sums as a pack has lanes.
template <class Real, int n_packs>
inline Pack<Real> sum_groups(const Pack<Real>* packs) {
  if constexpr (n_packs == 1)
    return *packs;
  else
    return fold<2 * width<Real> / n_packs, Real>(sum_groups<Real, n_packs / 2>(packs),
                                                 sum_groups<Real, n_packs / 2>(packs + n_packs / 2),
                                                 std::make_index_sequence<width<Real>>());
}

}  // namespace detail
#endif

/// Lane i of the result is the sum of the lanes of packs[i]; as many packs as lanes. Added in Real, in a fixed order.
template <class Real>
inline Pack<Real> sum_lanes_of_each(const Pack<Real>* packs) {
#if defined(SKEIN_HAS_SHUFFLES)
  return detail::sum_groups<Real, width<Real>>(packs);
#else
  Real sums[width<Real>];
  for (int i = 0; i < width<Real>; ++i) sums[i] = static_cast<Real>(sum_lanes(packs[i]));
  return load_pack(sums);
#endif
}

}  // namespace skein::simd
