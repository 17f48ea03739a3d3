#include <skein/solvers/rkc2_stages.hpp>

#include <algorithm>
#include <cmath>

namespace skein {

int count_rkc2_stages(const double dt, const double spectral_radius) {
  return std::max(2, 1 + static_cast<int>(std::sqrt(1.0 + 1.54 * dt * spectral_radius)));
}

}  // namespace skein
