#pragma once

#include <skein/analysis/centreline.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/physics/background_flow.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/spring_forces.hpp>
#include <skein/scene/scene_config.hpp>
#include <skein/solvers/integrator.hpp>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace skein::test {

/// One of the paper's fibers along x in its shear flow, ready to run.
struct PaperFiber {
  explicit PaperFiber(const int sections, const double blob_ratio = 1.0) {
    FiberConfig fiber;
    fiber.sections = sections;
    fiber.blob *= blob_ratio;
    scene.fibers = {fiber};
    fibers = make_fibers(scene.fibers);
    dynamics = std::make_unique<FiberDynamics>(
        fibers, std::make_unique<SpringForces>(fibers), make_background_flow(scene.flows),
        std::make_unique<DirectMobility>(scene.fluid.viscosity, Precision::in_double));
    state.position = to_device("position", make_surface_nodes(fibers));
  }

  int n_nodes() const { return state.position.extent_int(0); }
  double length() const { return fibers.front().length(); }

  SceneConfig scene;
  std::vector<Fiber> fibers;
  std::unique_ptr<FiberDynamics> dynamics;
  State state;
};

/// Degrees clockwise from +x, between -90 and 270: continuous over the half turn of a fiber that starts along x.
inline double clockwise_angle(const Vec3 v) {
  const double angle = -std::atan2(v.y, v.x) * 180.0 / std::numbers::pi;
  return angle < -90.0 ? angle + 360.0 : angle;
}

}  // namespace skein::test
