#include <skein/analysis/curvature_extrema.hpp>
#include <skein/core/error.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace skein {
namespace {

/// How far |curvature| falls on the way from s to a higher place or the end, going by `step`.
double find_saddle(const std::vector<double>& height, const int s, const int step) {
  double lowest = height[s];
  for (int i = s + step; i >= 0 && i < static_cast<int>(height.size()) && height[i] <= height[s]; i += step)
    lowest = std::min(lowest, height[i]);
  return lowest;
}

}  // namespace

std::vector<CurvatureExtremum> find_curvature_extrema(const std::span<const double> arclength,
                                                      const std::span<const double> curvature, const double least,
                                                      const double least_prominence) {
  SKEIN_REQUIRE(arclength.size() == curvature.size(), "one arclength for each curvature");
  constexpr int margin = 2;
  const int n = static_cast<int>(curvature.size());
  std::vector<CurvatureExtremum> extrema;
  // Extrema of one sign only compete with each other: where the sign changes the height is 0.
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> height(curvature.size());
    for (int s = 0; s < n; ++s) height[s] = std::max(0.0, sign * curvature[s]);
    for (int s = margin; s < n - margin; ++s) {
      if (height[s] < least || height[s] <= height[s - 1] || height[s] < height[s + 1]) continue;
      const double saddle = std::max(find_saddle(height, s, -1), find_saddle(height, s, 1));
      if (height[s] - saddle < least_prominence * height[s]) continue;
      const double before = height[s] - height[s - 1], after = height[s] - height[s + 1];
      const double shift = 0.5 * (before - after) / (before + after);  // in sections, within half of one
      const double spacing = 0.5 * (arclength[s + 1] - arclength[s - 1]);
      extrema.push_back({arclength[s] + shift * spacing, sign * (height[s] + 0.25 * shift * (before - after))});
    }
  }
  std::sort(extrema.begin(), extrema.end(), [](const auto& a, const auto& b) { return a.arclength < b.arclength; });
  return extrema;
}

LineFit ExtremumTrack::fit() const {
  double largest = 0.0;
  for (const double kappa : curvature) largest = std::max(largest, std::abs(kappa));
  std::vector<double> moments, places;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (std::abs(curvature[i]) < 0.5 * largest) continue;
    moments.push_back(time[i]);
    places.push_back(arclength[i]);
  }
  return fit_line(moments, places);
}

const char* name_of(const Wave wave) {
  switch (wave) {
    case Wave::standing:
      return "standing";
    case Wave::travelling:
      return "travelling";
    case Wave::unclear:
      break;
  }
  return "unclear";
}

std::vector<ExtremumTrack> track_extrema(const std::span<const double> time,
                                         const std::vector<std::vector<CurvatureExtremum>>& extrema,
                                         const double largest_step, const int least_moments) {
  SKEIN_REQUIRE(time.size() == extrema.size(), "one list of extrema for each time");
  std::vector<ExtremumTrack> tracks;
  for (std::size_t moment = 0; moment < time.size(); ++moment) {
    const auto& now = extrema[moment];
    std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;  // distance, track, extremum
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      if (!tracks[t].is_open) continue;
      for (std::size_t e = 0; e < now.size(); ++e) {
        const double distance = std::abs(now[e].arclength - tracks[t].arclength.back());
        if (distance <= largest_step && now[e].curvature * tracks[t].curvature.back() > 0.0)
          pairs.emplace_back(distance, t, e);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    std::vector<bool> is_used(now.size(), false), goes_on(tracks.size(), false);
    for (const auto& [distance, t, e] : pairs) {
      if (goes_on[t] || is_used[e]) continue;
      goes_on[t] = is_used[e] = true;
      tracks[t].time.push_back(time[moment]);
      tracks[t].arclength.push_back(now[e].arclength);
      tracks[t].curvature.push_back(now[e].curvature);
    }
    for (std::size_t t = 0; t < goes_on.size(); ++t) tracks[t].is_open = goes_on[t];
    for (std::size_t e = 0; e < now.size(); ++e)
      if (!is_used[e]) tracks.push_back({{time[moment]}, {now[e].arclength}, {now[e].curvature}, true});
  }
  std::erase_if(tracks, [&](const ExtremumTrack& t) { return static_cast<int>(t.time.size()) < least_moments; });
  return tracks;
}

Wave judge_wave(const ExtremumTrack& track, const double fiber_length) {
  const LineFit fit = track.fit();
  const auto [low, high] = std::minmax_element(track.arclength.begin(), track.arclength.end());
  const double span = travelling_span * fiber_length;
  const double travelled = std::abs(fit.slope) * (track.time.back() - track.time.front());
  if (travelled >= span && fit.determination >= 0.8) return Wave::travelling;
  return *high - *low < span ? Wave::standing : Wave::unclear;
}

}  // namespace skein
