#include "runs/parent_state.hpp"

#include <skein/core/error.hpp>
#include <skein/io/checkpoint_folder.hpp>
#include <skein/io/run_scene.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/io/trajectory_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

namespace skein {
namespace {

/// Of the interval of frames: times are typed as they were printed, and frames lie at products of numbers.
constexpr double time_tolerance = 1e-5;

// A folder's name may hold an "@" itself.
std::pair<std::string, std::optional<double>> split_name(const std::string& run) {
  std::error_code ignored;
  const auto at = run.rfind('@');
  if (at == std::string::npos || std::filesystem::exists(run, ignored)) return {run, std::nullopt};
  double time = 0.0;
  const char* last = run.data() + run.size();
  const auto [end, error] = std::from_chars(run.data() + at + 1, last, time);
  if (error != std::errc() || end != last || !std::isfinite(time))
    throw Error(ExitCode::usage, fmt::format("'{}' is no folder, and '{}' no time: write RUN, or RUN@TIME as in "
                                             "result@5.45",
                                             run, run.substr(at + 1)));
  return {run.substr(0, at), time};
}

std::string describe_nearest(const std::vector<double>& times, const double time) {
  if (times.empty()) return "it has no frames yet";
  if (time < times.front()) return fmt::format("its first is at t = {}", times.front());
  if (time > times.back()) return fmt::format("its last is at t = {}", times.back());
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  return fmt::format("the nearest are at t = {} and {}", *std::prev(after), *after);
}

void take_frame(ParentState& state, const double time) {
  const TrajectoryReader reader(state.folder, state.scene);
  const std::vector<double> times = reader.read_times();
  const auto nearest = std::min_element(times.begin(), times.end(), [time](const double a, const double b) {
    return std::abs(a - time) < std::abs(b - time);
  });
  if (nearest == times.end() || std::abs(*nearest - time) > time_tolerance * state.scene.output.frame_interval)
    throw Error(ExitCode::missing_input, fmt::format("the run '{}' has no frame at t = {}: {}", state.name, time,
                                                     describe_nearest(times, time)));
  const Frame frame = reader.read_frame(std::distance(times.begin(), nearest));
  state.time = frame.time;
  state.step = frame.step;
  state.position.reserve(3 * frame.position.size());
  for (const Vec3& v : frame.position) state.position.insert(state.position.end(), {v.x, v.y, v.z});
}

void take_checkpoint(ParentState& state) {
  const ResumePoint point = look_for_resume_point(state.folder);
  const auto& checkpoint = point.checkpoint;
  if (!checkpoint)
    throw Error(
        ExitCode::missing_input,
        fmt::format("the run '{0}' has no checkpoint yet; name the time of one of its frames: {0}@TIME", state.name));
  state.time = checkpoint->number("state.time");
  state.step = checkpoint->integer("state.step");
  state.position = checkpoint->numbers("state.position");
  for (const std::string& rejected : point.rejected) state.what_happened += rejected + "\n";
}

}  // namespace

ParentState read_parent_state(const std::string& run) {
  const auto [name, time] = split_name(run);
  const RunFolder folder = RunFolder::open(name);
  ParentState state{.folder = folder,
                    .scene = read_run_scene(folder),
                    .name = name,
                    .certificate = read_run_summary(folder.path()).certificate,
                    .position = {},
                    .what_happened = {}};
  if (time)
    take_frame(state, *time);
  else
    take_checkpoint(state);
  return state;
}

}  // namespace skein
