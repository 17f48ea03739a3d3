#pragma once

#include <limits>

namespace skein {

/// Wall times of one evaluation, seconds; not a number where it failed.
struct EvaluationCost {
  double seconds = std::numeric_limits<double>::quiet_NaN();  ///< the median of five after a warm-up
  double direct_seconds = 0.0;                                ///< of a direct sum, where the evaluation is none; else 0
};

}  // namespace skein
