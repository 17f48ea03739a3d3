#pragma once

#include <span>

namespace skein {

/// The least-squares line y = intercept + slope x.
struct LineFit {
  double slope = 0.0;
  double intercept = 0.0;
  double rms = 0.0;            ///< of the residuals
  double determination = 0.0;  ///< share of the variance of y that the line explains, 0 to 1
  int n_points = 0;
};

/// NaN for slope and intercept where fewer than two different x are given.
LineFit fit_line(std::span<const double> x, std::span<const double> y);

/// Exponential growth rate of an amplitude by a line through its logarithm, over the last stretch of moments in which
/// it stays between `low` and `high`. @returns slope 1 / time; n_points says over how many moments
LineFit fit_growth(std::span<const double> time, std::span<const double> amplitude, double low, double high);

}  // namespace skein
