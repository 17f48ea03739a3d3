#include <skein/analysis/line_fit.hpp>
#include <skein/core/error.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace skein {

LineFit fit_line(const std::span<const double> x, const std::span<const double> y) {
  SKEIN_REQUIRE(x.size() == y.size(), "one y for each x");
  LineFit fit;
  fit.n_points = static_cast<int>(x.size());
  const double n = fit.n_points;
  double mean_x = 0.0, mean_y = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
  }
  if (!(xx > 0.0)) {
    fit.slope = fit.intercept = std::numeric_limits<double>::quiet_NaN();
    return fit;
  }
  fit.slope = xy / xx;
  fit.intercept = mean_y - fit.slope * mean_x;
  const double unexplained = std::max(0.0, yy - fit.slope * xy);
  fit.rms = std::sqrt(unexplained / n);
  fit.determination = yy > 0.0 ? 1.0 - unexplained / yy : 1.0;
  return fit;
}

LineFit fit_growth(const std::span<const double> time, const std::span<const double> amplitude, const double low,
                   const double high) {
  SKEIN_REQUIRE(time.size() == amplitude.size(), "one amplitude for each time");
  const auto is_inside = [&](const std::size_t i) { return amplitude[i] >= low && amplitude[i] <= high; };
  std::size_t last = time.size();
  while (last > 0 && !is_inside(last - 1)) --last;
  std::size_t first = last;
  while (first > 0 && is_inside(first - 1)) --first;
  std::vector<double> logarithm;
  for (std::size_t i = first; i < last; ++i) logarithm.push_back(std::log(amplitude[i]));
  return fit_line(time.subspan(first, last - first), logarithm);
}

}  // namespace skein
