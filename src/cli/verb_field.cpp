#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>
#include <skein/io/trajectory_reader.hpp>
#include <skein/io/vtk_image.hpp>
#include <skein/scene/scene_file.hpp>

#include "cli/common_arguments.hpp"
#include "cli/plot_scripts.hpp"
#include "cli/verbs.hpp"
#include "runs/velocity_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace skein {
namespace {

struct FieldOptions {
  std::string folder, output, picture;
  std::optional<std::int64_t> frame;
  std::optional<double> time;
  std::string plane;
  std::vector<double> box;  ///< x0, x1, y0, y1, z0, z1
  int points = 0;           ///< along the longest side; 0: 200 on a plane, 64 in a box
  int threads = 0;
};

constexpr double largest_grid = 1e8;
constexpr double margin = 0.25;  ///< of the fibers' extent, where no box is given

struct Plane {
  int normal;
  double offset;
};

/// "z" or "y=0.1"
Plane parse_plane(const std::string& text) {
  const char axis = text.empty() ? ' ' : text[0];
  if (axis < 'x' || axis > 'z' || (text.size() > 1 && text[1] != '='))
    throw Error(ExitCode::usage, fmt::format("--plane {} is none: write x, y or z, or z=0.1", text));
  if (text.size() == 1) return {axis - 'x', 0.0};
  try {
    std::size_t end = 0;
    const double offset = std::stod(text.substr(2), &end);
    if (end + 2 == text.size() && std::isfinite(offset)) return {axis - 'x', offset};
  } catch (const std::exception&) {  // no number
  }
  throw Error(ExitCode::usage, fmt::format("--plane {}: '{}' is no number", text, text.substr(2)));
}

Frame read_frame(const TrajectoryReader& reader, const FieldOptions& options) {
  if (reader.n_frames() == 0) throw Error(ExitCode::missing_input, "the run has no frame yet");
  if (options.frame && (*options.frame < -reader.n_frames() || *options.frame >= reader.n_frames()))
    throw Error(ExitCode::usage,
                fmt::format("--frame {}: the run has frames 0 to {}", *options.frame, reader.n_frames() - 1));
  const std::int64_t wanted = options.frame.value_or(-1);
  const std::int64_t number = wanted < 0 ? wanted + reader.n_frames() : wanted;
  Frame chosen;
  double nearest = std::numeric_limits<double>::infinity();
  std::int64_t count = 0;
  reader.for_each_frame([&](const Frame& frame) {
    const bool is_it = options.time ? std::abs(frame.time - *options.time) < nearest : count == number;
    if (is_it) chosen = frame;
    if (is_it && options.time) nearest = std::abs(frame.time - *options.time);
    ++count;
  });
  return chosen;
}

using Corners = std::array<std::array<double, 2>, 3>;  ///< by axis: low and high

Corners find_corners(const std::vector<Vec3>& nodes) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Corners corners;
  corners.fill({infinity, -infinity});
  for (const Vec3 node : nodes) {
    const double value[] = {node.x, node.y, node.z};
    for (int axis = 0; axis < 3; ++axis)
      corners[axis] = {std::min(corners[axis][0], value[axis]), std::max(corners[axis][1], value[axis])};
  }
  double longest = 0.0;
  for (const auto& [low, high] : corners) longest = std::max(longest, high - low);
  for (auto& [low, high] : corners) {
    low -= margin * longest;
    high += margin * longest;
  }
  return corners;
}

ImageGrid make_grid(const FieldOptions& options, const std::vector<Vec3>& nodes) {
  Corners corners = find_corners(nodes);
  for (std::size_t i = 0; i < options.box.size(); ++i) corners[i / 2][i % 2] = options.box[i];
  const bool is_plane = !options.plane.empty() || options.box.empty();
  if (is_plane) {
    const Plane plane = parse_plane(options.plane.empty() ? "z" : options.plane);
    corners[plane.normal] = {plane.offset, plane.offset};
  }
  double longest = 0.0;
  for (const auto& [low, high] : corners) {
    if (low > high) throw Error(ExitCode::usage, fmt::format("--box: {:g} is above {:g}", low, high));
    longest = std::max(longest, high - low);
  }
  if (!(longest > 0.0)) throw Error(ExitCode::usage, "--box has no extent");
  const int n_longest = options.points > 0 ? options.points : is_plane ? 200 : 64;
  ImageGrid grid;
  grid.origin = {corners[0][0], corners[1][0], corners[2][0]};
  grid.spacing = longest / (n_longest - 1);
  double n_points = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    grid.n_points[axis] = 1 + static_cast<int>((corners[axis][1] - corners[axis][0]) / grid.spacing + 1e-9);
    n_points *= grid.n_points[axis];
  }
  if (n_points > largest_grid)
    throw Error(ExitCode::usage,
                fmt::format("{:.3g} points are more than {:g}: ask for fewer with --points", n_points, largest_grid));
  return grid;
}

int write_field(const FieldOptions& options) {
  const RunFolder folder = RunFolder::open(options.folder);
  const SceneConfig scene = read_scene(folder.scene(), {}).config;
  const Runtime runtime(options.threads);
  const Frame frame = read_frame(TrajectoryReader(folder), options);
  const ImageGrid grid = make_grid(options, frame.position);
  std::vector<Vec3> points;
  for (std::int64_t i = 0; i < grid.size(); ++i) points.push_back(grid.point(i));
  const VelocityField field = compute_velocity_field(scene, frame.time, frame.position, points);
  write_vtk_image(options.output, grid, frame.time, {{"velocity", field.total}, {"disturbance", field.disturbance}});
  fmt::print(stderr, "t = {:g}: {} x {} x {} points in '{}'\n", frame.time, grid.n_points[0], grid.n_points[1],
             grid.n_points[2], options.output);
  if (options.picture.empty()) return 0;
  return run_plot_script("plot_field.py", {std::filesystem::absolute(options.folder).string(),
                                           std::filesystem::absolute(options.output).string(),
                                           std::filesystem::absolute(options.picture).string()});
}

}  // namespace

Verb make_field_verb() {
  const auto options = std::make_shared<FieldOptions>();
  return {"field",
          "The fluid's velocity around the fibers at a frame, on a plane or in a box",
          {make_folder_argument(&options->folder),
           make_argument("--frame", &options->frame, "N", "Frame from 0, or from the end as -1 (default: the last)"),
           make_argument("--time", &options->time, "T", "The frame nearest to this time").exclude("--frame"),
           make_argument("--plane", &options->plane, "AXIS[=PLACE]",
                         "A plane by its normal and place, such as z or y=0.1 (default: z)"),
           make_argument("--box", &options->box, "X0,X1,Y0,Y1,Z0,Z1",
                         "Bounds of the box or, with --plane, of the plane (default: the fibers')")
               .exactly(6),
           make_argument("--points", &options->points, "N", "Points along the longest side (default: 200, in a box 64)")
               .within(2, 100000),
           make_argument("-o,--output", &options->output, "FILE", "File to write (.vti)").require(),
           make_argument("--plot", &options->picture, "PICTURE",
                         "Draw streamlines on the plane z, too (.png, .pdf or .svg)"),
           make_threads_option(&options->threads)},
          "Examples:\n"
          "  skein field tumbling --time 5.44 -o upright.vti --plot upright.png\n"
          "  skein field tumbling --frame -1 --plane y=0.01 --points 400 -o end.vti\n"
          "  skein field tumbling --frame 20 --box -0.1,0.1,-0.1,0.1,-0.05,0.05 -o box.vti\n"
          "The file is VTK's ImageData for ParaView, with the velocity and the disturbance that the fibers make of it.",
          [options] { return write_field(*options); }};
}

}  // namespace skein
