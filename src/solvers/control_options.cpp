#include <skein/solvers/control_options.hpp>

#include <algorithm>
#include <cmath>

namespace skein {

double ControlOptions::tolerance_root() const { return std::sqrt(tolerance * (2.5 * time_scale)); }

/// A fiber along the flow turns slowly, and what it is off by then grows with the square of its aspect ratio until it
/// flips: no local estimate sees that. The bound makes the error at the end fall with the tolerance (L = 0.139 orbit at
/// t = 6: 2.3e-4 L with steps up to 0.1, as the square of the bound).
double largest_controlled_step(const ControlOptions& options) {
  return std::min(options.max_step, 12.0 * options.tolerance_root() * options.time_scale);
}

}  // namespace skein
