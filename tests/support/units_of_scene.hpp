#pragma once

#include <skein/scene/scene_config.hpp>

namespace skein::test {

/// How many new units there are in an old one.
struct Units {
  double length = 1.0, time = 1.0, viscosity = 1.0;
  double force() const { return viscosity * length * length / time; }
};

/// The same scene, its fibers as written, in other units. Zeros that stand for what goes with the scene stay.
inline SceneConfig rescale(SceneConfig scene, const Units& units) {
  const double force = units.force(), length = units.length, time = units.time;
  scene.fluid.viscosity *= units.viscosity;
  for (FlowConfig& flow : scene.flows) {
    flow.rate /= time, flow.angular_frequency /= time;
    flow.center = length * flow.center, flow.size *= length;
    flow.start *= time, flow.stop *= time, flow.ramp *= time;
  }
  for (FiberConfig& fiber : scene.fibers) {
    fiber.radius *= length, fiber.blob *= length, fiber.spring_stiffness *= force;
    fiber.center = length * fiber.center, fiber.spacing *= length;
    fiber.helix_radius *= length, fiber.helix_pitch *= length;
    fiber.helix_taper *= length, fiber.helix_shaft *= length;
    fiber.bending_rigidity *= force * length * length;
    fiber.shear_couple *= force * time, fiber.end_couple *= force * length * time;
  }
  scene.repulsion.strength *= force / length, scene.repulsion.range *= length;
  scene.gravity.weight *= force / length;
  for (TetherConfig& tether : scene.tethers) {
    tether.stiffness *= force / length, tether.angular_frequency /= time;
    tether.point = length * tether.point, tether.swing = length * tether.swing;
    tether.velocity = (length / time) * tether.velocity;
  }
  for (TorqueConfig& torque : scene.torques) {
    torque.torque = (force * length) * torque.torque;
    torque.angular_velocity = (1.0 / time) * torque.angular_velocity;
  }
  for (ClampConfig& clamp : scene.clamps) {
    clamp.stiffness *= force / length, clamp.angular_frequency /= time, clamp.spin /= time;
    clamp.point = length * clamp.point, clamp.swing = length * clamp.swing;
  }
  for (UndulationConfig& wave : scene.undulations) {
    wave.curvature /= length, wave.wavelength *= length;
    wave.angular_frequency /= time, wave.ramp *= time;
  }
  scene.time.end *= time, scene.time.step *= time, scene.time.max_step *= time;
  scene.time.tolerance /= time;
  scene.output.frame_interval *= time;
  return scene;
}

}  // namespace skein::test
