// The summary of an analysis, for people and as JSON.
#include <skein/core/json.hpp>
#include <skein/fibers/node_orbits.hpp>

#include "runs/run_analysis.hpp"
#include "runs/swimming.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace skein {
namespace {

double smallest(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

template <class Value>
Value largest(const std::vector<Value>& values) {
  return *std::max_element(values.begin(), values.end());
}

std::string describe_contact(const RunAnalysis& analysis) {
  const int nodes = largest(analysis.nodes_inside), crossings = analysis.crossings.back();
  std::string text = fmt::format("smallest gap {:.4g}; ", smallest(analysis.smallest_gap));
  text += nodes == 0
              ? "no node inside of another surface; "
              : fmt::format("up to {} nodes inside of another surface, {:.4g} deep; ", nodes, largest(analysis.depth));
  return text + (crossings == 0 ? "no centreline passed through another"
                                : fmt::format("centrelines passed through each other {} times", crossings));
}

std::string describe_passages(const FiberSummary& summary) {
  std::string upright, aligned;
  for (const Passage& passage : summary.passages)
    (passage.quarter_turns % 2 == 0 ? aligned : upright) += fmt::format(" {:.4g}", passage.time);
  std::string text =
      fmt::format("  upright {}\n  aligned with the flow {}\n", upright.empty() ? "at no time" : "at t =" + upright,
                  aligned.empty() ? "at no time since the start" : "at t =" + aligned);
  if (!summary.half_periods.empty()) {
    text += "  half periods:";
    for (const double period : summary.half_periods) text += fmt::format(" {:.4g}", period);
    text += "\n";
  }
  return text;
}

// Without vorticity nothing turns a fiber about again and again.
std::string describe_angles(const FiberHistory& history) {
  const auto angles = history.angles();
  const auto [low, high] = std::minmax_element(angles.begin(), angles.end());
  return fmt::format("  angle from the {}: {:.4g} to {:.4g} degrees; a flow without vorticity has no half periods\n",
                     name_of(history.flow().angle_origin), degrees * *low, degrees * *high);
}

// Of a logarithm's variance that a line has to explain: bends that a flow forces grow otherwise.
constexpr double exponential = 0.999;

std::string describe_growth(const char* what, const LineFit& growth, const double least_determination) {
  constexpr int least_points = 10;
  if (growth.n_points < least_points || !(growth.determination >= least_determination)) return {};
  return fmt::format("  {} {:.4g} (r^2 = {:.4f}, {} frames)\n", what, growth.slope, growth.determination,
                     growth.n_points);
}

std::string describe_swimming(const std::optional<Swimming>& swimming) {
  if (!swimming) return {};
  const Vec3 u = swimming->velocity;
  return fmt::format(
      "  swims at {:.4g}, velocity ({:.4g}, {:.4g}, {:.4g}), mean from t = {:.4g} to {:.4g}\n"
      "  power {:.4g}; towing it straight at this speed takes {:.3g}: efficiency {:.3g} %\n",
      norm(u), u.x, u.y, u.z, swimming->begin, swimming->end, swimming->power, swimming->towing_power,
      100.0 * swimming->efficiency());
}

std::string describe_fiber(const RunAnalysis& analysis, const std::size_t fiber) {
  const FiberSummary summary = analysis.histories[fiber].summarize();
  std::string text = fmt::format("fiber {}: regime {}\n  regimes:", fiber, name_of(summary.regime));
  for (const RegimeChange& change : summary.changes)
    text += fmt::format(" {} from t = {:.4g}{}", name_of(change.regime), change.time,
                        &change == &summary.changes.back() ? "\n" : ",");
  const FiberHistory& history = analysis.histories[fiber];
  text += history.flow().turns_fibers() ? describe_passages(summary) : describe_angles(history);
  text += fmt::format("  largest curvature {:.4g}, stretch {:.3g} to {:.3g} %\n", summary.curvature_max,
                      100.0 * summary.stretch_min, 100.0 * summary.stretch_max);
  text += fmt::format("  extrema of curvature: {}, {} tracked\n", name_of(summary.wave), summary.tracks.size());
  if (summary.snaking)
    text += fmt::format("  hooks: radius {:.4g}, snaking speed {:.4g} (t = {:.4g} to {:.4g}, r^2 = {:.3f})\n",
                        summary.snaking->hook_radius, summary.snaking->speed, summary.snaking->begin,
                        summary.snaking->end, summary.snaking->determination);
  text += fmt::format(
      "  symmetry defect at most {:.3g} of the centreline length, out of its own plane at most {:.3g}{}\n",
      summary.symmetry_defect_max, summary.out_of_plane_max,
      summary.out_of_flow_plane_max ? fmt::format(", out of the flow's {:.3g}", *summary.out_of_flow_plane_max) : "");
  text += describe_growth("out-of-plane growth rate", summary.out_of_plane_growth, 0.0);
  text += describe_growth("buckling: deflection grows at rate", summary.deflection_growth, exponential);
  text += describe_swimming(measure_swimming(analysis, fiber));
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

void write_passages(JsonWriter& json, const FiberSummary& summary) {
  json.key("changes").begin_array();
  for (const RegimeChange& change : summary.changes)
    json.begin_object().member("time", change.time).member("regime", name_of(change.regime)).end_object();
  json.end_array().key("passages").begin_array();
  for (const Passage& passage : summary.passages)
    json.begin_object().member("time", passage.time).member("quarter_turns", passage.quarter_turns).end_object();
  json.end_array().key("half_periods").begin_array();
  for (const double period : summary.half_periods) json.value(period);
  json.end_array();
}

void write_hooks(JsonWriter& json, const std::optional<Snaking>& snaking) {
  if (!snaking) {
    json.key("hook_radius").null().key("snaking_speed").null();
    return;
  }
  json.member("hook_radius", snaking->hook_radius).member("snaking_speed", snaking->speed);
  json.member("snaking_from", snaking->begin).member("snaking_to", snaking->end);
}

void write_swimming(JsonWriter& json, const std::optional<Swimming>& swimming) {
  json.key("swimming");
  if (!swimming) {
    json.null();
    return;
  }
  const Vec3 u = swimming->velocity;
  json.begin_object().member("from", swimming->begin).member("to", swimming->end);
  json.key("velocity").begin_array().value(u.x).value(u.y).value(u.z).end_array();
  json.member("power", swimming->power).member("towing_power", swimming->towing_power);
  json.member("efficiency", swimming->efficiency()).end_object();
}

void write_fiber(JsonWriter& json, const RunAnalysis& analysis, const std::size_t fiber) {
  const FiberSummary summary = analysis.histories[fiber].summarize();
  json.begin_object().member("fiber", fiber).member("regime", name_of(summary.regime));
  json.member("angle_from", name_of(analysis.histories[fiber].flow().angle_origin));
  write_passages(json, summary);
  json.member("curvature_max", summary.curvature_max);
  json.key("stretch").begin_array().value(summary.stretch_min).value(summary.stretch_max).end_array();
  json.member("wave", name_of(summary.wave)).member("tracks", summary.tracks.size());
  write_hooks(json, summary.snaking);
  write_swimming(json, measure_swimming(analysis, fiber));
  json.member("symmetry_defect", summary.symmetry_defect_max).member("out_of_plane", summary.out_of_plane_max);
  json.key("out_of_flow_plane");
  summary.out_of_flow_plane_max ? json.value(*summary.out_of_flow_plane_max) : json.null();
  json.member("out_of_plane_growth", summary.out_of_plane_growth.slope);
  json.member("deflection_growth", summary.deflection_growth.slope);
  json.member("deflection_growth_r2", summary.deflection_growth.determination);
  json.member("energy_defect", measure_energy_defect(analysis, static_cast<int>(fiber))).end_object();
}

}  // namespace

std::string describe_analysis(const RunAnalysis& analysis) {
  std::string text = fmt::format("{} frames to t = {:.6g} ({}); {}\n", analysis.time.size(), analysis.time.back(),
                                 analysis.status, describe_contact(analysis));
  if (!analysis.scene.symmetry.is_none())
    text += fmt::format(
        "the scene is symmetric {} by assumption: defects and ways out of it are held at rounding, and no result\n",
        describe_symmetry(analysis.scene.symmetry));
  for (std::size_t f = 0; f < analysis.fibers.size(); ++f) text += describe_fiber(analysis, f);
  return text;
}

std::string describe_analysis_as_json(const RunAnalysis& analysis) {
  constexpr int n_open_levels = 3;  // of the run, the list of fibers, each fiber
  JsonWriter json(n_open_levels);
  json.begin_object().member("frames", analysis.time.size()).member("last_time", analysis.time.back());
  json.member("status", analysis.status).member("smallest_gap", smallest(analysis.smallest_gap));
  json.member("nodes_inside", largest(analysis.nodes_inside)).member("depth", largest(analysis.depth));
  json.member("crossings", analysis.crossings.back());
  json.member("assumed_symmetry", describe_symmetry(analysis.scene.symmetry));
  json.key("fibers").begin_array();
  for (std::size_t f = 0; f < analysis.fibers.size(); ++f) write_fiber(json, analysis, f);
  return json.end_array().end_object().take() + "\n";
}

}  // namespace skein
