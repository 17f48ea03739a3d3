#include "runs/swimming.hpp"

#include <skein/physics/flow_summary.hpp>
#include <skein/physics/rigid_tube.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein {
namespace {

/// When waves of a fiber have risen, and how long the slowest takes; a period of 0: none beats.
struct Beat {
  double risen = 0.0, period = 0.0;
};

Beat find_beat(const std::vector<UndulationConfig>& waves, const std::size_t fiber) {
  Beat beat;
  for (const UndulationConfig& wave : waves) {
    if (static_cast<std::size_t>(wave.fiber) != fiber || wave.curvature == 0.0) continue;
    beat.risen = std::max(beat.risen, wave.ramp);
    if (wave.angular_frequency != 0.0)
      beat.period = std::max(beat.period, 2.0 * std::numbers::pi / std::abs(wave.angular_frequency));
  }
  return beat;
}

}  // namespace

std::optional<Swimming> measure_swimming(const RunAnalysis& analysis, const std::size_t fiber) {
  const Beat beat = find_beat(analysis.scene.undulations, fiber);
  if (beat.period == 0.0 || analysis.forces.empty() || std::isfinite(summarize_flow(analysis.scene.flows).time_scale))
    return {};
  const std::vector<double>& time = analysis.time;
  const std::vector<ForceRecord>& records = analysis.forces[fiber];
  Swimming swimming;
  swimming.end = time.back();
  swimming.begin = swimming.end - beat.period;
  // Frames at multiples of an interval miss the period's begin by rounding.
  constexpr double rounding = 1e-9;
  if (swimming.begin < std::max(beat.risen, time.front()) - rounding * beat.period) return {};
  const auto next = std::upper_bound(time.begin(), time.end(), swimming.begin + rounding * beat.period);
  constexpr std::ptrdiff_t least_frames = 8;
  if (time.end() - next < least_frames) return {};
  const auto first = static_cast<std::size_t>(next - time.begin());
  const double share = std::clamp((swimming.begin - time[first - 1]) / (time[first] - time[first - 1]), 0.0, 1.0);
  const auto at_begin = [&](const auto before, const auto after) { return (1.0 - share) * before + share * after; };
  const Vec3 start = at_begin(records[first - 1].middle, records[first].middle);
  swimming.velocity = (records.back().middle - start) / beat.period;
  double before = swimming.begin;
  double heat = at_begin(records[first - 1].power.dissipation, records[first].power.dissipation);
  for (std::size_t i = first; i < records.size(); ++i) {
    const double now = records[i].power.dissipation;
    swimming.power += 0.5 * (heat + now) * (time[i] - before) / beat.period;
    heat = now;
    before = time[i];
  }
  const double drag = measure_rigid_tube(analysis.fibers[fiber], analysis.scene.fluid.viscosity).axial;
  swimming.towing_power = drag * dot(swimming.velocity, swimming.velocity);
  return swimming;
}

}  // namespace skein
