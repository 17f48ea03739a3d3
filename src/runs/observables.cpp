#include "runs/observables.hpp"

#include <skein/analysis/centreline.hpp>
#include <skein/analysis/shape.hpp>

#include <algorithm>

namespace skein {

Frame make_frame(const Physics& physics, const std::int64_t step, const double time, const ConstVectors& position) {
  Frame frame{step, time, to_host(position), physics.sections.compute_centreline(position), {}};
  for (const Fiber& fiber : physics.fibers) {
    const auto curvature = compute_curvature(centreline_of(fiber, frame.centreline));
    frame.curvature.insert(frame.curvature.end(), curvature.begin(), curvature.end());
  }
  return frame;
}

std::vector<Regime> classify_frame(const std::vector<Fiber>& fibers, const Frame& frame) {
  std::vector<Regime> regimes;
  for (const Fiber& fiber : fibers)
    regimes.push_back(classify_shape(
        measure_shape(centreline_of(fiber, frame.centreline), choose_curvature_reach(fiber)), fiber.config.radius));
  return regimes;
}

StepRecord make_step_record(const Physics& physics, const State& state, const StepReport& report,
                            const StepMeasures& measures) {
  const SectionRecord& sections = measures.sections;
  StepRecord record;
  record.step = state.step;
  record.time = state.time;
  record.dt = report.dt;
  record.error = report.error;
  record.spectral_radius = report.spectral_radius;
  record.energy = measures.energy;
  record.smallest_gap = sections.smallest_gap;
  record.nodes_inside = sections.penetration.nodes;
  record.depth = sections.penetration.depth;
  for (const Fiber& fiber : physics.fibers) {
    const auto line = centreline_of(fiber, sections.centreline);
    const auto curvature = compute_curvature(line);
    record.length.push_back(compute_length(line));
    record.curvature_max.push_back(*std::max_element(curvature.begin(), curvature.end()));
    record.symmetry_defect.push_back(compute_symmetry_defect(line));
    record.out_of_plane.push_back(compute_out_of_plane(line));
    record.end_to_end.push_back(compute_end_to_end(line));
  }
  return record;
}

}  // namespace skein
