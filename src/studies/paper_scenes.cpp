#include "studies/paper_scenes.hpp"

#include <skein/fibers/calibration.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace skein {

namespace {

/// Blobs over the radius with which the paper's tube meets the fluid alike whatever the nodes on its sections: the
/// rigid tube of L = 0.139 keeps its effective aspect ratio to 0.6 % (tests/accuracy/test_rigid_tube.cpp), the half
/// period at L = 0.523 stays within 0.5 %. With the blob kept, tubes of fewer nodes are thinner to the fluid, and leak.
struct FittedBlob {
  double nodes_per_section, over_radius;
};
constexpr std::array<FittedBlob, 6> fitted_blobs{{{3, 0.9}, {4, 0.7}, {5, 0.62}, {6, 0.57}, {9, 0.48}, {18, 0.45}}};

double interpolate_blob(const int nodes_per_section) {
  const auto* upper = std::find_if(fitted_blobs.begin() + 1, fitted_blobs.end() - 1,
                                   [&](const FittedBlob& row) { return row.nodes_per_section >= nodes_per_section; });
  const FittedBlob &low = upper[-1], &high = *upper;
  const double share = (nodes_per_section - low.nodes_per_section) / (high.nodes_per_section - low.nodes_per_section);
  return low.over_radius + share * (high.over_radius - low.over_radius);
}

}  // namespace

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
    config.blob *= interpolate_blob(nodes_per_section) / interpolate_blob(paper_nodes_per_section);
  }
  return scene;
}

}  // namespace skein
