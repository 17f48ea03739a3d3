#include "runs/force_probe.hpp"

#include <skein/arrays/combination.hpp>
#include <skein/dynamics/constrained_motion.hpp>

#include <span>

namespace skein {

std::vector<ForceRecord> probe_forces(const Physics& physics, const Frame& frame) {
  const auto position = to_device("skein::probe_forces::position", frame.position);
  const std::size_t n = frame.position.size();
  const Vectors force("skein::probe_forces::force", n), constraint("skein::probe_forces::constraint", n),
      induced("skein::probe_forces::induced", n), background("skein::probe_forces::background", n),
      velocity("skein::probe_forces::velocity", n);
  ConstrainedMotion motion(physics);
  motion.compute_places(position, position);
  motion.compute_forces(frame.time, position, force);
  physics.compute_forces(frame.time, position, constraint);
  combine<ExecSpace>(ExecSpace(), constraint, {1.0, force}, {-1.0, constraint});
  physics.mobility->add_velocity({position, force, physics.blob}, position, induced);
  physics.flow->add_velocity(frame.time, position, background);
  combine<ExecSpace>(ExecSpace(), velocity, {1.0, induced}, {1.0, background});
  const std::vector<Fiber>& fibers = physics.fibers;
  const auto energy = physics.compute_energies(frame.time, position);
  std::vector<SymmetricTensor> moments(fibers.size());
  std::vector<double> drive(fibers.size());
  for (const auto& part : physics.forces) {
    part->add_moments(fibers, frame.time, position, moments);
    part->add_drive_powers(frame.time, position, velocity, drive);
  }
  const auto x = to_host(ConstVectors(position)), rest = to_host(ConstVectors(constraint));
  const auto f = to_host(ConstVectors(force)), u = to_host(ConstVectors(induced)),
             b = to_host(ConstVectors(background));
  std::vector<ForceRecord> records;
  for (std::size_t i = 0; i < fibers.size(); ++i) {
    const Fiber& fiber = fibers[i];
    const auto part = [&](const std::vector<Vec3>& all) {
      return std::span(all).subspan(fiber.first_node, fiber.n_nodes());
    };
    Vec3 middle;
    for (const Vec3 place : part(x)) middle = middle + place / fiber.n_nodes();
    if (fiber.config.is_rigid()) {
      const SymmetricTensor moment = compute_symmetric_moment(part(x), part(rest));
      for (std::size_t c = 0; c < moment.size(); ++c) moments[i][c] += moment[c];
    }
    ForceRecord record;
    record.middle = middle;
    for (int node = 0; node < fiber.n_nodes(); ++node) {
      record.force = record.force + part(f)[node];
      record.torque = record.torque + cross(part(x)[node] - middle, part(f)[node]);
    }
    record.energy = energy[i];
    record.power = compute_power_balance(part(f), part(u), part(b));
    record.power.drive = drive[i];
    record.stresslet = compute_stresslet(moments[i]);
    record.viscosity_contribution =
        compute_viscosity_contribution(record.stresslet, physics.flow->gradient(frame.time, middle), physics.viscosity);
    records.push_back(record);
  }
  return records;
}

}  // namespace skein
