#include "runs/flow_samples.hpp"

#include <skein/io/csv_file.hpp>
#include <skein/io/run_scene.hpp>
#include <skein/io/trajectory_reader.hpp>
#include <skein/physics/scene_flow.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace skein {
namespace {

constexpr std::int64_t most_frames = 40;  ///< that are read for the box
constexpr int most_times = 60;
constexpr int n_along = 12, n_across = 5;  ///< points along the box's longest side, and along any at least
constexpr double margin = 0.1;             ///< of the longest side, on each side
constexpr double least_size = 0.3;         ///< of a side in the plane of x and y, of the longest

struct Box {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high = -low;

  void add(const Vec3 x) {
    low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
  }
};

Box find_box(const TrajectoryReader& reader) {
  Box box;
  const std::int64_t n = reader.n_frames(), step = std::max<std::int64_t>(1, n / most_frames);
  for (std::int64_t frame = 0; frame < n; frame += step)
    for (const Vec3 x : reader.read_frame(frame).centreline) box.add(x);
  return box;
}

/// Evenly over one side, with the margin; a flat one has its middle alone.
std::vector<double> divide(const double low, const double high, const double longest, const bool is_flat) {
  const double middle = 0.5 * (low + high), size = std::max(high - low, least_size * longest) + 2.0 * margin * longest;
  if (is_flat) return {middle};
  const int n =
      std::max(n_across, static_cast<int>(std::lround((n_along - 1) * size / (longest * (1.0 + 2.0 * margin)))));
  std::vector<double> places;
  for (int i = 0; i < n; ++i) places.push_back(middle + (static_cast<double>(i) / (n - 1) - 0.5) * size);
  return places;
}

/// Fibers that keep to a line of the plane of x and y, where most flows are, are shown the flow beside it.
std::vector<Vec3> make_grid(const Box& box) {
  const Vec3 size = box.high - box.low;
  const double longest = std::max({size.x, size.y, size.z, 1e-300});
  std::vector<Vec3> points;
  for (const double z : divide(box.low.z, box.high.z, longest, size.z < 0.1 * longest))
    for (const double y : divide(box.low.y, box.high.y, longest, false))
      for (const double x : divide(box.low.x, box.high.x, longest, false)) points.push_back({x, y, z});
  return points;
}

std::vector<double> choose_times(const SceneFlow& flow, const std::vector<double>& frame_times) {
  if (flow.is_steady()) return {frame_times.front()};
  std::vector<double> times;
  const std::size_t step = std::max<std::size_t>(1, frame_times.size() / most_times);
  for (std::size_t frame = 0; frame < frame_times.size(); frame += step) times.push_back(frame_times[frame]);
  return times;
}

}  // namespace

bool write_flow_samples(const RunFolder& folder, const std::filesystem::path& table) {
  const SceneConfig scene = read_run_scene(folder);
  const SceneFlow flow(scene.flows);
  if (!(flow.time_scale() < std::numeric_limits<double>::infinity())) return false;
  const TrajectoryReader reader(folder, scene);
  const std::vector<Vec3> points = make_grid(find_box(reader));
  const Vectors position = to_device("skein::flow_samples::position", points);
  std::vector<CsvRow> rows{{"time", "x", "y", "z", "u", "v", "w"}};
  for (const double time : choose_times(flow, reader.read_times())) {
    const Vectors velocity("skein::flow_samples::velocity", points.size());
    flow.add_velocity(time, position, velocity);
    const std::vector<Vec3> found = to_host(velocity);
    for (std::size_t i = 0; i < points.size(); ++i) {
      CsvRow row;
      for (const double number : {time, points[i].x, points[i].y, points[i].z, found[i].x, found[i].y, found[i].z})
        row.push_back(fmt::format("{}", number));
      rows.push_back(std::move(row));
    }
  }
  write_csv_rows(table, rows);
  return true;
}

}  // namespace skein
