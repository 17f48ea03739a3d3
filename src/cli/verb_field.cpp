#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>
#include <skein/io/array_file.hpp>
#include <skein/io/point_file.hpp>
#include <skein/io/run_scene.hpp>
#include <skein/io/trajectory_reader.hpp>
#include <skein/io/vtk_image.hpp>

#include "cli/common_arguments.hpp"
#include "cli/field_grid.hpp"
#include "cli/plot_scripts.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"
#include "runs/velocity_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace skein {
namespace {

struct FieldOptions {
  std::string folder, picture;
  std::filesystem::path output;
  std::optional<std::int64_t> frame;
  std::optional<double> time;
  FieldBounds bounds;
  std::string at;  ///< file of points; empty: a grid
  bool sum_directly = false;
  int threads = 0;
};

void check_options(const FieldOptions& options) {
  const FieldBounds& bounds = options.bounds;
  const bool has_grid = !bounds.plane.empty() || !bounds.box.empty() || bounds.points > 0 || !options.picture.empty();
  if (!options.at.empty() && has_grid)
    throw Error(ExitCode::usage, "--at says where the points are: --plane, --box, --points and --plot are for grids");
  const std::string ending = options.output.extension().string();
  if (!options.at.empty() && ending != ".csv" && ending != ".h5")
    throw Error(ExitCode::usage,
                fmt::format("--output {}: velocities at points are written as .csv or .h5", options.output.string()));
  if (options.at.empty() && ending != ".vti")
    throw Error(ExitCode::usage, fmt::format("--output {}: a grid is written as .vti", options.output.string()));
}

/// The frame nearest to a time among those of the run.
std::int64_t find_frame(const std::vector<double>& times, const double time) {
  constexpr double rounding = 1e-9;
  if (!std::isfinite(time)) throw Error(ExitCode::usage, fmt::format("--time {} is no time", time));
  if (time < 0.0 || time > times.back() + rounding * std::abs(times.back()))
    throw Error(ExitCode::usage, fmt::format("--time {:g}: the run has frames from t = {:g} to {:g}", time,
                                             times.front(), times.back()));
  const auto is_nearer = [time](const double a, const double b) { return std::abs(a - time) < std::abs(b - time); };
  return std::min_element(times.begin(), times.end(), is_nearer) - times.begin();
}

Frame read_frame(const TrajectoryReader& reader, const FieldOptions& options) {
  if (reader.n_frames() == 0) throw Error(ExitCode::missing_input, "the run has no frame yet");
  if (options.time) return reader.read_frame(find_frame(reader.read_times(), *options.time));
  const std::int64_t wanted = options.frame.value_or(-1);
  if (wanted < -reader.n_frames() || wanted >= reader.n_frames())
    throw Error(ExitCode::usage, fmt::format("--frame {}: the run has frames 0 to {}", wanted, reader.n_frames() - 1));
  return reader.read_frame(wanted < 0 ? wanted + reader.n_frames() : wanted);
}

std::vector<double> as_numbers(const std::vector<Vec3>& vectors) {
  std::vector<double> numbers;
  for (const Vec3 v : vectors) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  return numbers;
}

void write_point_table(const std::filesystem::path& path, const std::vector<NamedArray>& arrays) {
  std::vector<NamedArray> columns;
  for (const NamedArray& array : arrays)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string axis_name(1, "xyz"[axis]);
      NamedArray column{array.name == "position" ? axis_name : array.name + "_" + axis_name, array.unit, {}, {}};
      for (std::size_t i = axis; i < array.values.size(); i += 3) column.values.push_back(array.values[i]);
      columns.push_back(std::move(column));
    }
  write_csv(path, columns);
}

void write_points(const std::filesystem::path& path, const double time, const std::vector<Vec3>& points,
                  const VelocityField& field) {
  const std::vector<std::size_t> shape = {points.size(), 3};
  std::vector<NamedArray> arrays = {{"position", "length", shape, as_numbers(points)},
                                    {"velocity", "length/time", shape, as_numbers(field.total)},
                                    {"disturbance", "length/time", shape, as_numbers(field.disturbance)}};
  if (path.extension() == ".csv") return write_point_table(path, arrays);
  arrays.push_back({"time", "time", {}, {time}});
  write_array_file(path, arrays, {{"method", field.method}});
}

std::vector<Vec3> list_points(const ImageGrid& grid) {
  std::vector<Vec3> points;
  for (std::int64_t i = 0; i < grid.size(); ++i) points.push_back(grid.point(i));
  return points;
}

void check_outputs(const FieldOptions& options, const RunFolder& folder) {
  check_output(options.output, folder);
  std::error_code ignored;  // where one is not there
  if (!options.at.empty() && std::filesystem::equivalent(options.at, options.output, ignored))
    throw Error(ExitCode::cannot_create,
                fmt::format("'{}' holds the points and is not replaced; name another output.", options.at));
  if (options.picture.empty()) return;
  check_output(options.picture, folder);
  if (std::filesystem::path(options.picture).lexically_normal() == options.output.lexically_normal())
    throw Error(ExitCode::usage, fmt::format("'{}' cannot be both the field and its picture", options.picture));
}

int write_field(const FieldOptions& options) {
  const RunFolder folder = RunFolder::open(options.folder);
  check_outputs(options, folder);
  check_options(options);
  check_scene_is_of_run(folder);
  const SceneConfig scene = read_run_scene(folder);
  const Runtime runtime(options.threads);
  const Frame frame = read_frame(TrajectoryReader(folder, scene), options);
  const bool is_grid = options.at.empty();
  const ImageGrid grid = is_grid ? make_field_grid(options.bounds, frame.position) : ImageGrid{};
  const std::vector<Vec3> points = is_grid ? list_points(grid) : read_points(options.at);
  const VelocityField field =
      compute_velocity_field(scene, frame.time, frame.position, points,
                             options.sum_directly ? FieldSum::direct_in_double : FieldSum::as_the_run);
  for (const std::string& message : field.messages) print_warning(message);
  if (is_grid)
    write_vtk_image(options.output, grid, frame.time, {{"velocity", field.total}, {"disturbance", field.disturbance}});
  else
    write_points(options.output, frame.time, points, field);
  const std::string count = is_grid ? fmt::format("{} x {} x {}", grid.n_points[0], grid.n_points[1], grid.n_points[2])
                                    : fmt::format("{}", points.size());
  print_message(
      fmt::format("t = {:g}: {} points in '{}'; {}", frame.time, count, options.output.string(), field.method));
  if (options.picture.empty()) return 0;
  return run_plot_script("plot_field.py", {std::filesystem::absolute(options.folder).string(),
                                           std::filesystem::absolute(options.output).string(),
                                           std::filesystem::absolute(options.picture).string()});
}

}  // namespace

Verb make_field_verb() {
  const auto options = std::make_shared<FieldOptions>();
  return {
      "field",
      "The fluid's velocity around the fibers at a frame, on a plane, in a box or at given points",
      {make_folder_argument(&options->folder),
       make_argument("--frame", &options->frame, "N", "Frame from 0, or from the end as -1 (default: the last)"),
       make_argument("--time", &options->time, "T", "The frame nearest to this time").exclude("--frame"),
       make_argument("--plane", &options->bounds.plane, "AXIS[=PLACE]",
                     "A plane by its normal and place, such as z or y=0.1 (default: z)"),
       make_argument("--box", &options->bounds.box, "X0,X1,Y0,Y1,Z0,Z1",
                     "Bounds of the box or, with --plane, of the plane (default: the fibers')")
           .exactly(6),
       make_argument("--points", &options->bounds.points, "N",
                     "Points along the longest side (default: 200, in a box 64); sides are covered to their ends")
           .within(2, 100000),
       make_argument("--at", &options->at, "POINTS", "Instead of a grid: points from a text of lines x, y, z"),
       make_argument("-o,--output", &options->output, "FILE", "File to write: .vti, with --at .csv or .h5").require(),
       make_argument("--plot", &options->picture, "PICTURE",
                     "Draw streamlines on the plane z, too (.png, .pdf or .svg)"),
       make_flag("--direct", &options->sum_directly,
                 "Sum pair by pair in double precision, whatever the scene's [hydrodynamics] says"),
       make_threads_option(&options->threads)},
      "Examples:\n"
      "  skein field tumbling --time 5.44 -o upright.vti --plot upright.png\n"
      "  skein field tumbling --frame -1 --plane y=0.01 --points 400 -o end.vti\n"
      "  skein field tumbling --frame 20 --box -0.1,0.1,-0.1,0.1,-0.05,0.05 -o box.vti\n"
      "  skein field tumbling --time 5.44 --at probes.csv -o velocities.csv\n"
      "The file is VTK's ImageData for ParaView, with the velocity and the disturbance that the fibers make of it;\n"
      "with --at a table, or an HDF5 file of arrays.",
      [options] { return write_field(*options); }};
}

}  // namespace skein
