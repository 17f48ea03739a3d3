#pragma once

#include <cstdint>
#include <limits>

namespace skein {

/// What a method that approximates knows of its own error, since the beginning of the run.
struct ErrorRecord {
  int order = 0;  ///< of the last evaluation's expansions; 0: it was a direct sum
  /// Of the last check against direct sums and of the worst, relative (2-norm); not a number before the first.
  double last = std::numeric_limits<double>::quiet_NaN(), largest = std::numeric_limits<double>::quiet_NaN();
  std::int64_t n_checks = 0;
  std::int64_t n_misses = 0;       ///< checks that found more than the tolerance
  std::int64_t n_approximate = 0;  ///< evaluations that were no direct sums
};

}  // namespace skein
