#include "perf/orbit_scene.hpp"

#include <skein/fibers/calibration.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/physics/direct_mobility.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace skein::perf {

SceneConfig make_orbit_scene(const OrbitScene& orbit) {
  SceneConfig scene;
  FiberConfig paper, fiber;
  fiber.nodes_per_section = orbit.nodes;
  const double spacing = 2.0 * fiber.radius * std::sin(std::numbers::pi / orbit.nodes);
  fiber.sections =
      orbit.sections > 0 ? orbit.sections : std::max(3, static_cast<int>(std::lround(orbit.length / spacing)));
  const double wanted = measure_beam_stiffness(make_fibers({paper}).front()).infinite_bending;
  const double found = measure_beam_stiffness(make_fibers({fiber}).front()).infinite_bending;
  fiber.spring_stiffness *= orbit.stiffness * wanted / found;
  fiber.blob *= orbit.blob;
  scene.fibers = {fiber};
  return scene;
}

Physics make_direct_physics(const SceneConfig& scene) {
  Physics physics = make_physics(scene);
  physics.mobility = std::make_unique<DirectMobility>(scene.fluid.viscosity, Precision::in_double);
  return physics;
}

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, norm(a[i] - b[i]));
  return largest;
}

}  // namespace skein::perf
