#include "runs/run_analysis.hpp"

#include <skein/core/error.hpp>
#include <skein/io/run_scene.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/io/trajectory_reader.hpp>
#include <skein/physics/flow_summary.hpp>

#include "runs/run_analyzer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace skein {
namespace {

/// Energies and powers of all fibers together.
std::vector<ForceRecord> add_up(const std::vector<std::vector<ForceRecord>>& forces) {
  std::vector<ForceRecord> sum(forces.front().size());
  for (const auto& records : forces)
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i].energy += records[i].energy;
      sum[i].power.background += records[i].power.background;
      sum[i].power.dissipation += records[i].power.dissipation;
      sum[i].power.drive += records[i].power.drive;
    }
  return sum;
}

}  // namespace

RunAnalysis analyze_run(const RunFolder& folder, const bool with_forces) {
  std::string status = read_run_summary(folder.path()).status;
  const SceneConfig scene = read_run_scene(folder);
  const Physics physics = make_physics(scene);
  const auto gradient = [&](const Vec3 position) { return compute_typical_gradient(scene.flows, position); };
  RunAnalyzer analyzer(scene, physics, gradient, with_forces);
  TrajectoryReader(folder, scene).for_each_frame([&](const Frame& frame) { analyzer.add(frame); });
  RunAnalysis analysis = analyzer.take();
  if (analysis.time.empty())
    throw Error(ExitCode::missing_input, fmt::format("the run '{}' holds no frame yet.", folder.path().string()));
  analysis.status = std::move(status);
  return analysis;
}

double measure_energy_defect(const RunAnalysis& analysis, const int fiber) {
  if (analysis.forces.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto records = analysis.shares_energy ? add_up(analysis.forces) : analysis.forces[fiber];
  double integral = 0.0, defect = 0.0, exchanged = 0.0;
  for (std::size_t i = 1; i < records.size(); ++i) {
    const double half_step = 0.5 * (analysis.time[i] - analysis.time[i - 1]);
    integral += half_step * (records[i].power.elastic() + records[i - 1].power.elastic());
    exchanged += half_step * (records[i].power.dissipation + records[i - 1].power.dissipation);
    defect = std::max(defect, std::abs(records[i].energy - records[0].energy - integral));
  }
  // What it costs to drag the fiber by a billionth of its length in all this time: less is rounding.
  const double length = analysis.fibers[fiber].length(), span = analysis.time.back() - analysis.time.front();
  const double least = 8.0 * std::numbers::pi * analysis.scene.fluid.viscosity * length * std::pow(1e-9 * length, 2);
  return exchanged * span > least ? defect / exchanged : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace skein
