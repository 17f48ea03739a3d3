#pragma once

#include <skein/io/read_file.hpp>
#include <skein/io/trajectory_writer.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace skein {

// Two fibers that differ in everything, one of them with an odd number of nodes on a section; they drift and turn, and
// stay tubes of their radius. No solver is involved. `scene`: the text that scene.toml of the run folder holds.
inline TrajectoryLayout make_synthetic_layout(const std::string& scene = "scene") {
  FiberConfig first;
  first.sections = 7;
  first.nodes_per_section = 6;
  first.radius = 0.03;
  first.center = {0.2, -0.4, 0.1};
  FiberConfig second;
  second.sections = 5;
  second.nodes_per_section = 9;
  second.radius = 0.07;
  second.center = {-0.3, 0.6, 0.5};
  second.direction = {0.3, 1.1, -0.4};

  TrajectoryLayout layout;
  layout.fibers = make_fibers({first, second});
  layout.blobs = make_blobs(layout.fibers);
  layout.attributes = {{"title", "two synthetic tubes"}, {"scene", scene}, {"version", "1.2.3"}};
  layout.parameters = {{"shear_rate", {2.5, "1/time"}},
                       {"bending_rigidity", {std::vector<double>{4.8e-6, 3.1e-5}, "force*length^2"}},
                       {"elasto_viscous_number", {std::vector<double>{535.0, 71.0}, ""}}};
  return layout;
}

inline Frame make_synthetic_frame(const TrajectoryLayout& layout, const int number) {
  Frame frame;
  frame.step = 10 * number;
  frame.time = 0.05 * number;
  const double angle = 0.3 * number;
  for (const Vec3 x : make_surface_nodes(layout.fibers))
    frame.position.push_back({std::cos(angle) * x.x - std::sin(angle) * x.y + 0.01 * number,
                              std::sin(angle) * x.x + std::cos(angle) * x.y, x.z - 0.02 * number});
  for (const Fiber& fiber : layout.fibers) {
    const int n = fiber.config.nodes_per_section;
    for (int section = 0; section < fiber.config.sections; ++section) {
      Vec3 centroid;
      for (int node = 0; node < n; ++node)
        centroid = centroid + frame.position[fiber.first_node + section * n + node] / n;
      frame.centreline.push_back(centroid);
      frame.curvature.push_back(0.7 * section + 0.001 * number);
    }
  }
  return frame;
}

inline StepRecord make_synthetic_record(const int step) {
  StepRecord record;
  record.step = step;
  record.time = 0.005 * step;
  record.dt = 0.005;
  record.error = 0.3;
  record.estimated_error = 2e-7 * (step + 1);
  record.spectral_radius = 1.1e4;
  record.evaluations = 12 * step;
  record.smallest_gap = 0.21;
  record.energy = {1e-6 * step, 2e-6 * step};
  record.length = {0.21, 0.24};
  record.curvature_max = {1.3, 1.7};
  record.symmetry_defect = {1e-3, 2e-3};
  record.out_of_plane = {0.01, 0.02};
  record.end_to_end = {{0.2, 0.01 * step, 0.0}, {0.1, 0.2, 0.03}};
  return record;
}

inline constexpr SegmentLimits never{.bytes = 1 << 30, .seconds = 1e9};

// Frames 0, 1 | 2 | 3, 4 with ten steps between two frames.
inline void write_three_segments(const RunFolder& folder, const OutputConfig& output) {
  const TrajectoryLayout layout = make_synthetic_layout(read_file(folder.scene()));
  TrajectoryWriter writer(folder, layout, output, never);
  for (int frame = 0; frame < 5; ++frame) {
    for (int step = 10 * frame - 9; step <= 10 * frame; ++step)
      if (step > 0) writer.append(make_synthetic_record(step));
    writer.append(make_synthetic_frame(layout, frame));
    if (frame == 1 || frame == 2) writer.close_segment();
  }
  writer.finish("done");
}

}  // namespace skein
