#include "runs/run_analysis.hpp"

#include <skein/analysis/centreline.hpp>
#include <skein/core/error.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/io/trajectory_reader.hpp>
#include <skein/physics/background_flow.hpp>
#include <skein/physics/make_mobility.hpp>
#include <skein/physics/section_repulsion.hpp>
#include <skein/physics/spring_forces.hpp>
#include <skein/scene/scene_file.hpp>

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

/// Takes a moment's part without trace from a stresslet. @param moment  xx, yy, zz, yz, xz, xy
void subtract_moment(const std::array<double, 6>& moment, Matrix3& stresslet) {
  const double third = (moment[0] + moment[1] + moment[2]) / 3.0;
  for (int a = 0; a < 3; ++a) {
    stresslet[a][a] -= moment[a] - third;
    for (int b = 0; b < 3; ++b)
      if (b != a) stresslet[a][b] -= moment[6 - a - b];
  }
}

/// Springs, repulsion, flow and fluid of a scene, asked for what they do at given positions.
class ForceProbe {
 public:
  ForceProbe(const SceneConfig& scene, const std::vector<Fiber>& fibers)
      : fibers_(fibers),
        viscosity_(scene.fluid.viscosity),
        springs_(fibers),
        repulsion_(make_section_repulsion(scene.repulsion, fibers)),
        flow_(make_background_flow(scene.flows)),
        mobility_(make_mobility(scene)),
        blob_(to_device("skein::ForceProbe::blob", make_blobs(fibers))) {}

  std::vector<ForceRecord> look(const Frame& frame) {
    const auto position = to_device("skein::ForceProbe::position", frame.position);
    const std::size_t n = frame.position.size();
    const Vectors force("skein::ForceProbe::force", n), induced("skein::ForceProbe::induced", n),
        background("skein::ForceProbe::background", n);
    springs_.compute_forces(position, force);
    const auto elastic = to_host(ConstVectors(force));
    auto energy = springs_.compute_energies(position);
    std::vector<std::array<double, 6>> moments(fibers_.size());
    if (repulsion_ != nullptr) {
      repulsion_->add_forces(position, force);
      repulsion_->add_energies(position, energy);
      moments = repulsion_->compute_moments(position);
    }
    mobility_->add_velocity({position, force, blob_}, position, induced);
    flow_->add_velocity(frame.time, position, background);
    const auto f = to_host(ConstVectors(force)), u = to_host(ConstVectors(induced)),
               b = to_host(ConstVectors(background));
    std::vector<ForceRecord> records;
    for (std::size_t i = 0; i < fibers_.size(); ++i) {
      const Fiber& fiber = fibers_[i];
      const auto part = [&](const std::vector<Vec3>& all) {
        return std::span(all).subspan(fiber.first_node, fiber.n_nodes());
      };
      Vec3 middle;
      for (const Vec3 x : part(frame.position)) middle = middle + x / fiber.n_nodes();
      ForceRecord record;
      record.energy = energy[i];
      record.power = compute_power_balance(part(f), part(u), part(b));
      record.stresslet = compute_stresslet(part(frame.position), part(elastic));
      if (repulsion_ != nullptr) subtract_moment(moments[i], record.stresslet);
      record.viscosity_contribution = compute_viscosity_contribution(
          record.stresslet, compute_strain_rate(flow_->gradient(frame.time, middle)), viscosity_);
      records.push_back(record);
    }
    return records;
  }

 private:
  const std::vector<Fiber>& fibers_;
  double viscosity_;
  SpringForces springs_;
  std::unique_ptr<SectionRepulsion> repulsion_;  ///< null: none
  std::unique_ptr<BackgroundFlow> flow_;
  std::unique_ptr<Mobility> mobility_;
  Scalars blob_;
};

/// Energies and powers of all fibers together.
std::vector<ForceRecord> add_up(const std::vector<std::vector<ForceRecord>>& forces) {
  std::vector<ForceRecord> sum(forces.front().size());
  for (const auto& records : forces)
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i].energy += records[i].energy;
      sum[i].power.background += records[i].power.background;
      sum[i].power.dissipation += records[i].power.dissipation;
    }
  return sum;
}

}  // namespace

RunAnalysis analyze_run(const RunFolder& folder, const bool with_forces) {
  RunAnalysis analysis;
  analysis.scene = read_scene(folder.scene(), {}).config;
  analysis.fibers = make_fibers(analysis.scene.fibers);
  analysis.status = read_run_summary(folder.path()).status;
  for (const Fiber& fiber : analysis.fibers) analysis.histories.emplace_back(fiber);
  std::unique_ptr<ForceProbe> probe;
  if (with_forces) {
    probe = std::make_unique<ForceProbe>(analysis.scene, analysis.fibers);
    analysis.forces.resize(analysis.fibers.size());
  }
  const auto n_nodes = static_cast<std::size_t>(count_nodes(analysis.fibers));
  const auto n_sections = static_cast<std::size_t>(count_sections(analysis.fibers));
  TrajectoryReader(folder).for_each_frame([&](const Frame& frame) {
    if (frame.position.size() != n_nodes || frame.centreline.size() != n_sections)
      throw Error(ExitCode::damaged_data,
                  fmt::format("the frames in '{}' do not fit its scene.toml.", folder.path().string()));
    analysis.time.push_back(frame.time);
    analysis.smallest_gap.push_back(compute_smallest_gap(analysis.fibers, frame.centreline));
    for (std::size_t f = 0; f < analysis.fibers.size(); ++f)
      analysis.histories[f].add(frame.time, centreline_of(analysis.fibers[f], frame.centreline));
    if (!probe) return;
    const auto records = probe->look(frame);
    for (std::size_t f = 0; f < records.size(); ++f) analysis.forces[f].push_back(records[f]);
  });
  if (analysis.time.empty())
    throw Error(ExitCode::missing_input, fmt::format("the run '{}' holds no frame yet.", folder.path().string()));
  return analysis;
}

double measure_energy_defect(const RunAnalysis& analysis, const int fiber) {
  if (analysis.forces.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto records = analysis.scene.repulsion.strength > 0.0 ? add_up(analysis.forces) : analysis.forces[fiber];
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
