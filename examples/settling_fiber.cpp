// A scene in three lines: physics, dynamics, integrator. A soft fiber settles across its length under a force that is
// set by hand at first, then bends; its ends fall behind its middle.

#include <skein/arrays/runtime.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/dynamics/make_integrator.hpp>

#include "settling_weight.hpp"

#include <cstdio>

int main() {
  const skein::Runtime runtime;  // first, and last to go: it holds the device

  skein::SceneConfig scene;
  scene.fluid.viscosity = 1.0;
  scene.flows = {{.rate = 0.0}};  // a fluid at rest
  skein::FiberConfig fiber;
  fiber.sections = 40;
  fiber.nodes_per_section = 6;
  fiber.radius = 0.01;
  fiber.blob = 0.01;
  scene.fibers = {fiber};

  skein::Physics physics = skein::make_physics(scene);
  physics.forces.push_back(std::make_unique<SettlingWeight>(skein::Vec3{0.0, 0.0, -0.0002}));
  skein::FiberDynamics dynamics(physics);
  const auto integrator = skein::make_integrator(scene, physics, dynamics);

  skein::State state{0.0, 0, skein::to_device("position", skein::make_surface_nodes(physics.fibers))};
  while (state.time < 2.0) integrator->advance(state, 2.0);

  const auto line = physics.sections.compute_centreline(state.position);
  const double middle = line[line.size() / 2].z, end = line.front().z;
  std::printf("t = %g after %lld steps: middle at z = %.5f, end at z = %.5f\n", state.time,
              static_cast<long long>(state.step), middle, end);
  return middle < -0.01 && end > middle ? 0 : 1;
}
