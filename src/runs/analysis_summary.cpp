// The summary of an analysis, for people and as JSON.
#include <skein/core/json_text.hpp>

#include "runs/run_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein {
namespace {

std::string number_or_null(const double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

std::string list_json(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + number_or_null(value);
  return "[" + text + "]";
}

double smallest(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

std::string describe_passages(const FiberSummary& summary) {
  std::string upright, aligned;
  for (const Passage& passage : summary.passages)
    (passage.quarter_turns % 2 == 0 ? aligned : upright) += fmt::format(" {:.4g}", passage.time);
  return fmt::format("  upright {}\n  aligned with x {}\n", upright.empty() ? "at no time" : "at t =" + upright,
                     aligned.empty() ? "at no time since the start" : "at t =" + aligned);
}

// Of a logarithm's variance that a line has to explain: bends that a flow forces grow otherwise.
constexpr double exponential = 0.999;

std::string describe_growth(const char* what, const LineFit& growth, const double least_determination) {
  constexpr int least_points = 10;
  if (growth.n_points < least_points || !(growth.determination >= least_determination)) return {};
  return fmt::format("  {} {:.4g} (r^2 = {:.4f}, {} frames)\n", what, growth.slope, growth.determination,
                     growth.n_points);
}

std::string describe_fiber(const RunAnalysis& analysis, const std::size_t fiber) {
  const FiberSummary summary = analysis.histories[fiber].summarize();
  std::string text = fmt::format("fiber {}: regime {}\n  regimes:", fiber, name_of(summary.regime));
  for (const RegimeChange& change : summary.changes)
    text += fmt::format(" {} from t = {:.4g}{}", name_of(change.regime), change.time,
                        &change == &summary.changes.back() ? "\n" : ",");
  text += describe_passages(summary);
  if (!summary.half_periods.empty()) {
    text += "  half periods:";
    for (const double period : summary.half_periods) text += fmt::format(" {:.4g}", period);
    text += "\n";
  }
  text += fmt::format("  largest curvature {:.4g}, stretch {:.3g} to {:.3g} %\n", summary.curvature_max,
                      100.0 * summary.stretch_min, 100.0 * summary.stretch_max);
  text += fmt::format("  extrema of curvature: {}, {} tracked\n", name_of(summary.wave), summary.tracks.size());
  if (summary.snaking)
    text += fmt::format("  hooks: radius {:.4g}, snaking speed {:.4g} (t = {:.4g} to {:.4g}, r^2 = {:.3f})\n",
                        summary.snaking->hook_radius, summary.snaking->speed, summary.snaking->begin,
                        summary.snaking->end, summary.snaking->determination);
  text += fmt::format("  symmetry defect at most {:.3g} of the length, out of the plane at most {:.3g}\n",
                      summary.symmetry_defect_max, summary.out_of_plane_max);
  text += describe_growth("out-of-plane growth rate", summary.out_of_plane_growth, 0.0);
  text += describe_growth("buckling: deflection grows at rate", summary.deflection_growth, exponential);
  if (!analysis.forces.empty()) {
    double energy = 0.0, viscosity = 0.0;
    const auto& forces = analysis.forces[fiber];
    for (std::size_t i = 1; i < forces.size(); ++i) {
      energy = std::max(energy, forces[i].energy);
      viscosity += 0.5 * (forces[i].viscosity_contribution + forces[i - 1].viscosity_contribution) *
                   (analysis.time[i] - analysis.time[i - 1]);
    }
    const double duration = analysis.time.back() - analysis.time.front();
    const double length = analysis.fibers[fiber].length();
    text += fmt::format("  elastic energy at most {:.4g}; power balance closes to {:.2g} of what is dissipated\n",
                        energy, measure_energy_defect(analysis, static_cast<int>(fiber)));
    if (duration > 0.0 && std::isfinite(viscosity))
      text += fmt::format("  a suspension's viscosity grows by {:.4g} n L^3 of the fluid's, mean over the run\n",
                          viscosity / duration / std::pow(length, 3));
  }
  return text;
}

std::string describe_fiber_as_json(const RunAnalysis& analysis, const std::size_t fiber) {
  const FiberSummary summary = analysis.histories[fiber].summarize();
  std::string changes, passages;
  for (const RegimeChange& change : summary.changes)
    changes += fmt::format("{}{{\"time\": {}, \"regime\": {}}}", changes.empty() ? "" : ", ", change.time,
                           quote_json(name_of(change.regime)));
  for (const Passage& passage : summary.passages)
    passages += fmt::format("{}{{\"time\": {}, \"quarter_turns\": {}}}", passages.empty() ? "" : ", ", passage.time,
                            passage.quarter_turns);
  std::string text = fmt::format(
      "    {{\"fiber\": {}, \"regime\": {}, \"changes\": [{}],\n     \"passages\": [{}], \"half_periods\": {},\n"
      "     \"curvature_max\": {}, \"stretch\": [{}, {}], \"wave\": {}, \"tracks\": {},\n",
      fiber, quote_json(name_of(summary.regime)), changes, passages, list_json(summary.half_periods),
      number_or_null(summary.curvature_max), number_or_null(summary.stretch_min), number_or_null(summary.stretch_max),
      quote_json(name_of(summary.wave)), summary.tracks.size());
  text +=
      summary.snaking
          ? fmt::format("     \"hook_radius\": {}, \"snaking_speed\": {}, \"snaking_from\": {}, \"snaking_to\": {},\n",
                        number_or_null(summary.snaking->hook_radius), number_or_null(summary.snaking->speed),
                        summary.snaking->begin, summary.snaking->end)
          : "     \"hook_radius\": null, \"snaking_speed\": null,\n";
  text += fmt::format(
      "     \"symmetry_defect\": {}, \"out_of_plane\": {}, \"out_of_plane_growth\": {},\n"
      "     \"deflection_growth\": {}, \"deflection_growth_r2\": {},\n"
      "     \"energy_defect\": {}}}",
      number_or_null(summary.symmetry_defect_max), number_or_null(summary.out_of_plane_max),
      number_or_null(summary.out_of_plane_growth.slope), number_or_null(summary.deflection_growth.slope),
      number_or_null(summary.deflection_growth.determination),
      number_or_null(measure_energy_defect(analysis, static_cast<int>(fiber))));
  return text;
}

}  // namespace

std::string describe_analysis(const RunAnalysis& analysis) {
  std::string text = fmt::format("{} frames to t = {:.6g} ({}); smallest gap {:.4g}\n", analysis.time.size(),
                                 analysis.time.back(), analysis.status, smallest(analysis.smallest_gap));
  for (std::size_t f = 0; f < analysis.fibers.size(); ++f) text += describe_fiber(analysis, f);
  return text;
}

std::string describe_analysis_as_json(const RunAnalysis& analysis) {
  std::string fibers;
  for (std::size_t f = 0; f < analysis.fibers.size(); ++f)
    fibers += (f == 0 ? "" : ",\n") + describe_fiber_as_json(analysis, f);
  return fmt::format(
      "{{\n  \"frames\": {}, \"last_time\": {}, \"status\": {}, \"smallest_gap\": {},\n  \"fibers\": [\n{}\n  ]\n}}\n",
      analysis.time.size(), analysis.time.back(), quote_json(analysis.status),
      number_or_null(smallest(analysis.smallest_gap)), fibers);
}

}  // namespace skein
