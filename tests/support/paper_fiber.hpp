#pragma once

#include <skein/analysis/centreline.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/scene/scene_config.hpp>
#include <skein/solvers/integrator.hpp>

#include "tests/support/direct_physics.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace skein::test {

/// One of the paper's fibers along x in its shear flow, ready to run.
struct PaperFiber {
  explicit PaperFiber(const int sections, const double blob_ratio = 1.0)
      : PaperFiber(make_scene(sections, blob_ratio)) {}
  explicit PaperFiber(const SceneConfig& asked)
      : scene(asked),
        physics(make_direct_physics(scene)),
        dynamics(physics),
        state{0.0, 0, to_device("position", make_surface_nodes(physics.fibers))} {}
  PaperFiber(const PaperFiber&) = delete;
  PaperFiber& operator=(const PaperFiber&) = delete;

  int n_nodes() const { return state.position.extent_int(0); }
  double length() const { return physics.fibers.front().length(); }
  Vec3 end_to_end(const ConstVectors& position) const {
    return compute_end_to_end(physics.sections.compute_centreline(position));
  }

  SceneConfig scene;
  Physics physics;
  FiberDynamics dynamics;
  State state;

 private:
  static SceneConfig make_scene(const int sections, const double blob_ratio) {
    SceneConfig scene;
    FiberConfig fiber;
    fiber.sections = sections;
    fiber.blob *= blob_ratio;
    scene.fibers = {fiber};
    return scene;
  }
};

/// Degrees clockwise from +x, between -90 and 270: continuous over the half turn of a fiber that starts along x.
inline double clockwise_angle(const Vec3 v) {
  const double angle = -std::atan2(v.y, v.x) * 180.0 / std::numbers::pi;
  return angle < -90.0 ? angle + 360.0 : angle;
}

}  // namespace skein::test
