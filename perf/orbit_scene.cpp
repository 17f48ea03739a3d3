#include "perf/orbit_scene.hpp"

#include <skein/scene/calibration.hpp>
#include <skein/scene/fiber.hpp>

#include <algorithm>
#include <cmath>
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

}  // namespace skein::perf
