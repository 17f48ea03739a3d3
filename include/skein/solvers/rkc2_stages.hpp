#pragma once

namespace skein {

/// Of the estimate of the spectral radius: sections that ovalize blow up within 20 steps of one that is too low.
inline constexpr double rkc2_spectral_margin = 1.2;

/// Stages for a stable step of RKC2: 1 + int(sqrt(1 + 1.54 dt radius)), at least 2. @param spectral_radius  1 / time
int count_rkc2_stages(double dt, double spectral_radius);

}  // namespace skein
