#include "studies/paper_scenes.hpp"

#include <skein/fibers/calibration.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {

SceneConfig make_paper_scene(const int sections, const double end) {
  SceneConfig scene;  // whose flow is the paper's by default: shear of rate 2.5
  FiberConfig fiber;
  fiber.sections = sections;
  fiber.nodes_per_section = paper_nodes_per_section;
  fiber.radius = 0.005;
  fiber.spring_stiffness = 0.0112;
  fiber.blob = 0.00225;
  scene.fibers = {fiber};
  scene.time.end = end;
  scene.output.frame_interval = 0.05;
  scene.title = fmt::format("Fiber of {} sections in shear (LaGrone et al. 2019)", sections);
  return scene;
}

SceneConfig coarsen(SceneConfig scene, const int nodes_per_section) {
  for (FiberConfig& config : scene.fibers) {
    if (config.nodes_per_section == nodes_per_section) continue;
    const Fiber fine = make_fibers({config})[0];
    config.nodes_per_section = nodes_per_section;
    const double spacing = make_fibers({config})[0].spacing();
    config.sections = std::max(2, static_cast<int>(std::lround(fine.length() / spacing)));
    // Rigidity is in proportion to the springs' stiffness.
    const Fiber coarse = make_fibers({config})[0];
    config.spring_stiffness *=
        measure_beam_stiffness(fine).infinite_bending / measure_beam_stiffness(coarse).infinite_bending;
  }
  return scene;
}

}  // namespace skein
