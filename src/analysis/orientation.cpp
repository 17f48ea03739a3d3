#include <skein/analysis/orientation.hpp>
#include <skein/core/error.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein {
namespace {

constexpr double quarter = 0.5 * std::numbers::pi;
constexpr double aligned = 0.02;  // radians: a fiber that starts so near to a quarter turn stands at it

}  // namespace

double compute_clockwise_angle(const Vec3 vector, const FlowFrame& frame) {
  return -std::atan2(dot(vector, frame.gradient), dot(vector, frame.along)) + 0.0;
}

std::vector<double> unwrap_angles(const std::span<const double> angle) {
  std::vector<double> unwrapped(angle.begin(), angle.end());
  double turns = 0.0;
  for (std::size_t i = 1; i < angle.size(); ++i) {
    const double change = angle[i] - angle[i - 1];
    turns -= std::round(change / (2.0 * std::numbers::pi));
    unwrapped[i] = angle[i] + 2.0 * std::numbers::pi * turns;
  }
  return unwrapped;
}

std::vector<Passage> find_passages(const std::span<const double> time, const std::span<const double> angle) {
  SKEIN_REQUIRE(time.size() == angle.size(), "one angle for each time");
  std::vector<Passage> passages;
  if (angle.size() < 2) return passages;
  const auto [low, high] = std::minmax_element(angle.begin(), angle.end());
  const double sense = *high - angle[0] >= angle[0] - *low ? 1.0 : -1.0;
  auto next = static_cast<int>(std::floor((sense * angle[0] + aligned) / quarter)) + 1;
  for (std::size_t i = 1; i < angle.size(); ++i) {
    const double before = sense * angle[i - 1], now = sense * angle[i];
    for (; now >= next * quarter; ++next) {
      const double weight = now > before ? (next * quarter - before) / (now - before) : 1.0;
      passages.push_back(
          {time[i - 1] + std::clamp(weight, 0.0, 1.0) * (time[i] - time[i - 1]), static_cast<int>(sense) * next});
    }
  }
  return passages;
}

std::vector<double> find_half_periods(const std::span<const double> time, const std::span<const double> angle) {
  std::vector<double> moments, periods;
  if (!angle.empty() && std::abs(std::remainder(angle[0], 2.0 * quarter)) <= aligned) moments.push_back(time[0]);
  for (const Passage& passage : find_passages(time, angle))
    if (passage.quarter_turns % 2 == 0) moments.push_back(passage.time);
  for (std::size_t i = 1; i < moments.size(); ++i) periods.push_back(moments[i] - moments[i - 1]);
  return periods;
}

}  // namespace skein
