#pragma once

#include <skein/core/math.hpp>

namespace skein {

/// 0 up to a share of 0, 1 from a share of 1 on, and a cubic without kinks in between.
SKEIN_INLINE_FUNCTION double smooth_step(const double share) {
  if (share <= 0.0) return 0.0;
  return share >= 1.0 ? 1.0 : share * share * (3.0 - 2.0 * share);
}

/// Its derivative.
SKEIN_INLINE_FUNCTION double smooth_step_slope(const double share) {
  return share <= 0.0 || share >= 1.0 ? 0.0 : 6.0 * share * (1.0 - share);
}

}  // namespace skein
