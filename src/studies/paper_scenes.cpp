#include "studies/paper_scenes.hpp"

#include <skein/fibers/fiber.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {

SceneConfig make_paper_scene(const int sections, const double end) {
  SceneConfig scene;  // whose flow is the paper's by default: shear of rate 2.5
  FiberConfig fiber;
  fiber.sections = sections;
  fiber.nodes_per_section = paper_nodes_per_section;
  fiber.radius = paper_radius;
  fiber.spring_stiffness = 0.0112;
  fiber.blob = 0.00225;
  scene.fibers = {fiber};
  scene.time.end = end;
  scene.output.frame_interval = 0.05;
  scene.title = fmt::format("Fiber of {} sections in shear (LaGrone et al. 2019)", sections);
  return scene;
}

int count_paper_sections(const double length) {
  const double spacing = make_fibers(make_paper_scene(80, 1.0).fibers)[0].spacing();
  return std::max(2, static_cast<int>(std::lround(length / spacing)));
}

}  // namespace skein
