#include "runs/run_analyzer.hpp"

#include <skein/analysis/centreline.hpp>
#include <skein/analysis/crossing.hpp>

#include "runs/force_probe.hpp"

namespace skein {

RunAnalyzer::RunAnalyzer(const SceneConfig& scene, const Physics& physics, GradientAt gradient, const bool with_forces)
    : physics_(physics), gradient_(std::move(gradient)) {
  analysis_.scene = scene;
  analysis_.fibers = physics.fibers;
  analysis_.shares_energy = physics.has_force_between_fibers();
  if (with_forces) analysis_.forces.resize(physics.fibers.size());
}

void RunAnalyzer::begin_histories(const Frame& frame) {
  const double time_scale = physics_.time_scale();
  for (const Fiber& fiber : physics_.fibers) {
    Vec3 middle;
    for (const Vec3 x : centreline_of(fiber, frame.centreline)) middle = middle + x / fiber.config.sections;
    analysis_.histories.emplace_back(fiber, make_flow_frame(gradient_(middle)), time_scale);
  }
}

void RunAnalyzer::add(const Frame& frame) {
  if (analysis_.histories.empty()) begin_histories(frame);
  analysis_.time.push_back(frame.time);
  const auto position = to_device("skein::RunAnalyzer::position", frame.position);
  const SectionRecord sections = physics_.sections.look(position);
  analysis_.smallest_gap.push_back(sections.smallest_gap);
  analysis_.nodes_inside.push_back(sections.penetration.nodes);
  analysis_.depth.push_back(sections.penetration.depth);
  const int n_before = analysis_.crossings.empty() ? 0 : analysis_.crossings.back();
  const int n_new = before_.empty() ? 0 : count_crossings(analysis_.fibers, before_, frame.centreline);
  analysis_.crossings.push_back(n_before + n_new);
  before_ = frame.centreline;
  for (std::size_t f = 0; f < analysis_.fibers.size(); ++f)
    analysis_.histories[f].add(frame.time, centreline_of(analysis_.fibers[f], frame.centreline));
  if (analysis_.forces.empty()) return;
  const auto records = probe_forces(physics_, frame);
  for (std::size_t f = 0; f < records.size(); ++f) analysis_.forces[f].push_back(records[f]);
}

}  // namespace skein
