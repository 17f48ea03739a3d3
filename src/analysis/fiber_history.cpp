#include <skein/analysis/fiber_history.hpp>
#include <skein/analysis/plane_fit.hpp>
#include <skein/core/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein {
namespace {

// Extrema below this share of the run's largest curvature are those of a nearly straight fiber.
constexpr double least_share_of_peak = 0.3;
// A hook is measured from the moment its end points backwards, for so many time scales: enough for a line fit, and over
// before the hooks of short fibers meet.
constexpr double snaking_window = 5.0;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Wave judge_waves(const std::vector<ExtremumTrack>& tracks, const double fiber_length) {
  double seconds[3] = {0.0, 0.0, 0.0};
  for (const ExtremumTrack& track : tracks)
    seconds[static_cast<int>(judge_wave(track, fiber_length))] += track.time.back() - track.time.front();
  return static_cast<Wave>(std::max_element(seconds, seconds + 3) - seconds);
}

// A bend that buckles grows exponentially once the modes that decay are gone, and as long as it is small.
LineFit fit_first_growth(const std::vector<double>& time, const std::vector<double>& deflection,
                         const double fiber_length) {
  const double rounding = std::numeric_limits<double>::epsilon() * fiber_length;
  const double low = std::max(3.0 * deflection.front(), 1e3 * rounding), high = 0.01 * fiber_length;
  const auto first = std::find_if(deflection.begin(), deflection.end(), [=](const double d) { return d >= low; });
  const auto last = std::lower_bound(first, std::is_sorted_until(first, deflection.end()), high);
  const auto offset = static_cast<std::size_t>(first - deflection.begin());
  const auto count = static_cast<std::size_t>(last - first);
  return fit_growth(std::span(time).subspan(offset, count), std::span(deflection).subspan(offset, count), low, high);
}

}  // namespace

FiberHistory::FiberHistory(const Fiber& fiber, const FlowFrame& flow, const double time_scale)
    : fiber_(fiber), flow_(flow), plane_(flow), time_scale_(time_scale), reach_(choose_curvature_reach(fiber)) {}

void FiberHistory::add(const double time, const std::span<const Vec3> centreline) {
  SKEIN_REQUIRE(static_cast<int>(centreline.size()) == fiber_.config.sections, "one point for each section");
  SKEIN_REQUIRE(time_.empty() || time > time_.back(), "times grow");
  const PlaneTracker::Plane plane = plane_.follow(centreline, reach_);
  if (plane.turns_over) turn_over();
  const auto arclength = compute_arclength(centreline);
  const auto curvature = compute_signed_curvature(centreline, reach_, plane.normal);
  time_.push_back(time);
  arclength_.insert(arclength_.end(), arclength.begin(), arclength.end());
  curvature_.insert(curvature_.end(), curvature.begin(), curvature.end());
  shapes_.push_back(measure_shape(centreline, reach_, plane.normal));
  if (flow_.has_plane()) out_of_flow_plane_.push_back(find_largest_height(centreline, flow_.normal));
  regimes_.push_back(classify_shape(shapes_.back(), fiber_.config.radius));
  hooks_[0].push_back(find_hook(centreline, arclength, curvature, FiberEnd::first));
  hooks_[1].push_back(find_hook(centreline, arclength, curvature, FiberEnd::last));
}

void FiberHistory::turn_over() {
  for (double& kappa : curvature_) kappa = -kappa;
  for (Shape& shape : shapes_) shape.turn_over();
  for (auto& hooks : hooks_)
    for (auto& hook : hooks)
      if (hook) hook->bend.turning = -hook->bend.turning;
}

std::vector<double> FiberHistory::angles() const {
  std::vector<Vec3> end_to_end;
  for (const Shape& shape : shapes_) end_to_end.push_back(shape.end_to_end);
  return measure_angles(flow_, end_to_end);
}

std::vector<ExtremumTrack> FiberHistory::make_tracks() const {
  double peak = 0.0;
  for (const Shape& shape : shapes_) peak = std::max(peak, shape.curvature_max);
  // A fiber that never bends has extrema of rounding.
  const double least = std::max(least_share_of_peak * peak, least_bend_turning / fiber_.length());
  const auto n = static_cast<std::size_t>(fiber_.config.sections);
  std::vector<std::vector<CurvatureExtremum>> extrema;
  for (std::size_t moment = 0; moment < time_.size(); ++moment)
    extrema.push_back(find_curvature_extrema(std::span(arclength_).subspan(moment * n, n),
                                             std::span(curvature_).subspan(moment * n, n), least));
  constexpr double radii_per_step = 3.0;
  return track_extrema(time_, extrema, radii_per_step * fiber_.config.radius);
}

std::optional<Snaking> FiberHistory::measure_snaking() const {
  Snaking snaking;
  std::vector<double> radii, speeds;
  snaking.determination = 1.0;
  snaking.begin = std::numeric_limits<double>::infinity();
  for (const auto& hooks : hooks_) {
    const auto is_folded = [](const std::optional<Hook>& h) {
      return h && std::abs(h->bend.turning) >= RegimeLimits{}.folded;
    };
    const auto first = static_cast<std::size_t>(std::find_if(hooks.begin(), hooks.end(), is_folded) - hooks.begin());
    std::vector<double> time, place, radius;
    for (std::size_t i = first;
         i < hooks.size() && is_folded(hooks[i]) && time_[i] <= time_[first] + snaking_window * time_scale_; ++i) {
      time.push_back(time_[i]);
      place.push_back(hooks[i]->arclength);
      radius.push_back(hooks[i]->circle.radius);
    }
    constexpr std::size_t least_moments = 5;
    if (time.size() < least_moments) continue;
    const LineFit fit = fit_line(time, place);
    speeds.push_back(fit.slope);
    radii.insert(radii.end(), radius.begin(), radius.end());
    snaking.determination = std::min(snaking.determination, fit.determination);
    snaking.begin = std::min(snaking.begin, time.front());
    snaking.end = std::max(snaking.end, time.back());
  }
  if (speeds.empty()) return std::nullopt;
  for (const double speed : speeds) snaking.speed += speed / static_cast<double>(speeds.size());
  snaking.hook_radius = median(radii);
  return snaking;
}

FiberSummary FiberHistory::summarize() const {
  SKEIN_REQUIRE(!time_.empty(), "a history has moments");
  FiberSummary summary;
  if (flow_.turns_fibers()) {
    const auto angle = angles();
    summary.passages = find_passages(time_, angle);
    summary.half_periods = find_half_periods(time_, angle);
  }
  summary.changes = find_regime_changes(time_, regimes_);
  summary.regime = classify_run(regimes_);
  summary.tracks = make_tracks();
  summary.wave = judge_waves(summary.tracks, fiber_.length());
  summary.snaking = measure_snaking();
  std::vector<double> out_of_plane, deflection;
  for (const Shape& shape : shapes_) {
    const double stretch = shape.length / shapes_.front().length - 1.0;
    summary.stretch_min = std::min(summary.stretch_min, stretch);
    summary.stretch_max = std::max(summary.stretch_max, stretch);
    summary.curvature_max = std::max(summary.curvature_max, shape.curvature_max);
    summary.symmetry_defect_max = std::max(summary.symmetry_defect_max, shape.symmetry_defect);
    summary.out_of_plane_max = std::max(summary.out_of_plane_max, shape.out_of_plane);
    out_of_plane.push_back(shape.out_of_plane);
    deflection.push_back(shape.deflection);
  }
  const double rounding = std::numeric_limits<double>::epsilon() * fiber_.length();
  if (flow_.has_plane()) {
    out_of_plane = out_of_flow_plane_;
    summary.out_of_flow_plane_max = *std::max_element(out_of_plane.begin(), out_of_plane.end());
  }
  summary.out_of_plane_growth = fit_growth(time_, out_of_plane, 1e3 * rounding, 0.1 * fiber_.config.radius);
  summary.deflection_growth = fit_first_growth(time_, deflection, fiber_.length());
  return summary;
}

}  // namespace skein
