#include "runs/run_analysis.hpp"

#include <skein/analysis/centreline.hpp>
#include <skein/arrays/combination.hpp>
#include <skein/core/error.hpp>
#include <skein/io/run_scene.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/io/trajectory_reader.hpp>
#include <skein/physics/physics.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace skein {
namespace {

/// E, the symmetric part of a velocity gradient.
Matrix3 compute_strain_rate(const VelocityGradient& gradient) {
  Matrix3 strain{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) strain[i][j] = 0.5 * (gradient[i][j] + gradient[j][i]);
  return strain;
}

/// What forces and fluid of a scene do at given positions.
class ForceProbe {
 public:
  explicit ForceProbe(Physics& physics) : physics_(physics) {}

  std::vector<ForceRecord> look(const Frame& frame) {
    const auto position = to_device("skein::ForceProbe::position", frame.position);
    const std::size_t n = frame.position.size();
    const Vectors force("skein::ForceProbe::force", n), induced("skein::ForceProbe::induced", n),
        background("skein::ForceProbe::background", n), velocity("skein::ForceProbe::velocity", n);
    physics_.compute_forces(frame.time, position, force);
    physics_.mobility->add_velocity({position, force, physics_.blob}, position, induced);
    physics_.flow->add_velocity(frame.time, position, background);
    combine<ExecSpace>(ExecSpace(), velocity, {1.0, induced}, {1.0, background});
    const std::vector<Fiber>& fibers = physics_.fibers;
    const auto energy = physics_.compute_energies(frame.time, position);
    std::vector<SymmetricTensor> moments(fibers.size());
    std::vector<double> drive(fibers.size());
    for (const auto& part : physics_.forces) {
      part->add_moments(fibers, frame.time, position, moments);
      part->add_drive_powers(frame.time, position, velocity, drive);
    }
    const auto f = to_host(ConstVectors(force)), u = to_host(ConstVectors(induced)),
               b = to_host(ConstVectors(background));
    std::vector<ForceRecord> records;
    for (std::size_t i = 0; i < fibers.size(); ++i) {
      const Fiber& fiber = fibers[i];
      const auto part = [&](const std::vector<Vec3>& all) {
        return std::span(all).subspan(fiber.first_node, fiber.n_nodes());
      };
      Vec3 middle;
      for (const Vec3 x : part(frame.position)) middle = middle + x / fiber.n_nodes();
      ForceRecord record;
      record.energy = energy[i];
      record.power = compute_power_balance(part(f), part(u), part(b));
      record.power.drive = drive[i];
      record.stresslet = compute_stresslet(moments[i]);
      record.viscosity_contribution = compute_viscosity_contribution(
          record.stresslet, compute_strain_rate(physics_.flow->gradient(frame.time, middle)), physics_.viscosity);
      records.push_back(record);
    }
    return records;
  }

 private:
  Physics& physics_;
};

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
  RunAnalysis analysis;
  analysis.status = read_run_summary(folder.path()).status;
  analysis.scene = read_run_scene(folder);
  Physics physics = make_physics(analysis.scene);
  analysis.fibers = physics.fibers;
  analysis.shares_energy = physics.has_force_between_fibers();
  for (const Fiber& fiber : analysis.fibers) analysis.histories.emplace_back(fiber, physics.time_scale());
  ForceProbe probe(physics);
  if (with_forces) analysis.forces.resize(analysis.fibers.size());
  TrajectoryReader(folder, analysis.scene).for_each_frame([&](const Frame& frame) {
    analysis.time.push_back(frame.time);
    analysis.smallest_gap.push_back(
        physics.sections.compute_smallest_gap(to_device("skein::analyze_run::position", frame.position)));
    for (std::size_t f = 0; f < analysis.fibers.size(); ++f)
      analysis.histories[f].add(frame.time, centreline_of(analysis.fibers[f], frame.centreline));
    if (!with_forces) return;
    const auto records = probe.look(frame);
    for (std::size_t f = 0; f < records.size(); ++f) analysis.forces[f].push_back(records[f]);
  });
  if (analysis.time.empty())
    throw Error(ExitCode::missing_input, fmt::format("the run '{}' holds no frame yet.", folder.path().string()));
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
  return exchanged > 0.0 ? defect / exchanged : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace skein
