#include <skein/core/error.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/io/trajectory_reader.hpp>

#include "hdf5_reader.hpp"
#include "segment.hpp"

#include <fmt/format.h>

namespace skein {
namespace {

std::vector<Vec3> take_vectors(const std::vector<double>& values, const std::size_t row, const std::size_t n) {
  std::vector<Vec3> vectors(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double* value = &values[3 * (row * n + i)];
    vectors[i] = {value[0], value[1], value[2]};
  }
  return vectors;
}

}  // namespace

TrajectoryReader::TrajectoryReader(const RunFolder& folder) : folder_(folder) {
  const RunSummary summary = read_run_summary(folder.path());
  n_segments_ = summary.segments;
  n_frames_ = summary.frames;
}

void TrajectoryReader::for_each_frame(const std::function<void(const Frame&)>& visit) const {
  for (std::int64_t number = 0; number < n_segments_; ++number) {
    const auto path = folder_.path() / segment_name(number);
    const Hdf5Reader file(path);
    const auto time = file.read_reals("/particles/fibers/position/time");
    const auto step = file.read_integers("/particles/fibers/position/step");
    const auto position = file.read_reals("/particles/fibers/position/value");
    const auto centreline = file.read_reals("/observables/centreline/value");
    const auto curvature = file.read_reals("/observables/curvature/value");
    if (time.empty()) continue;
    const std::size_t n_nodes = position.size() / time.size() / 3, n_sections = curvature.size() / time.size();
    if (step.size() != time.size() || position.size() != 3 * n_nodes * time.size() ||
        curvature.size() != n_sections * time.size() || centreline.size() != 3 * curvature.size())
      throw Error(ExitCode::damaged_data, fmt::format("the frames in '{}' are damaged.", path.string()));
    for (std::size_t i = 0; i < time.size(); ++i) {
      const auto first = curvature.begin() + static_cast<std::ptrdiff_t>(i * n_sections);
      visit({step[i],
             time[i],
             take_vectors(position, i, n_nodes),
             take_vectors(centreline, i, n_sections),
             {first, first + static_cast<std::ptrdiff_t>(n_sections)}});
    }
  }
}

}  // namespace skein
