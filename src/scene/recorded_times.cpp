#include <skein/scene/recorded_times.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein {
namespace {

/// Whether only rounding keeps a time from an end, in every unit of time: a frame there would double the end's.
bool is_at_an_end(const SceneConfig& scene, const double time) {
  const double rounding = 1e-9 * scene.output.frame_interval;
  const auto is_at = [=](const double end) { return std::abs(time - end) <= rounding; };
  const auto& earlier = scene.time.earlier_ends;
  return is_at(scene.time.end) || std::any_of(earlier.begin(), earlier.end(), is_at);
}

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double most_intervals = 1e15;  // more cannot be counted by ones in doubles

/// The first multiple of the interval, as a product in doubles, that is above a time of 0 or more and no end; infinite
/// where there is no interval, or one that is nothing beside the time, as only scenes that no run wrote have.
double find_next_multiple(const SceneConfig& scene, const double after) {
  const double interval = scene.output.frame_interval;
  if (!(after < most_intervals * interval)) return infinity;
  double number = std::max(std::floor(after / interval) - 1.0, 0.0);  // the quotient may be rounded up
  while (number * interval <= after || is_at_an_end(scene, number * interval)) number += 1.0;
  return number * interval;
}

}  // namespace

double find_next_end(const TimeConfig& time, const double after) {
  for (const double end : time.earlier_ends)
    if (end > after) return end;
  return time.end > after ? time.end : infinity;
}

double find_next_frame(const SceneConfig& scene, const double after) {
  const double end = find_next_end(scene.time, after);
  return std::isfinite(end) ? std::min(end, find_next_multiple(scene, after)) : end;
}

bool is_frame_time(const SceneConfig& scene, const double time) {
  return time == scene.time.start || find_next_frame(scene, std::nextafter(time, -1.0)) == time;
}

}  // namespace skein
