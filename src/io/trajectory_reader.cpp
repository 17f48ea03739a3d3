#include <skein/core/error.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/io/trajectory_reader.hpp>

#include "moments.hpp"
#include "segment_chain.hpp"
#include "series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace skein {
namespace {

/// All frames of one segment.
struct SegmentFrames {
  Moments moments;
  std::vector<double> position, centreline, curvature;  ///< [n_frames, ...], as in a file

  Frame frame(std::size_t row) const;
};

std::vector<double> take_row(const std::vector<double>& values, const std::size_t row, const std::size_t n_rows) {
  const std::size_t n = values.size() / n_rows;
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * n);
  return {first, first + static_cast<std::ptrdiff_t>(n)};
}

std::vector<Vec3> as_vectors(const std::vector<double>& values) {
  std::vector<Vec3> vectors(values.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return vectors;
}

Frame SegmentFrames::frame(const std::size_t row) const {
  const std::size_t n_rows = moments.n_rows();
  return {moments.step[row], moments.time[row], as_vectors(take_row(position, row, n_rows)),
          as_vectors(take_row(centreline, row, n_rows)), take_row(curvature, row, n_rows)};
}

Moments read_frame_moments(const Hdf5Reader& file, const std::int64_t n_frames) {
  Moments moments = read_moments(file, "/particles/fibers/position");
  if (moments.n_rows() != static_cast<hsize_t>(n_frames))
    file.reject("/particles/fibers/position/time",
                fmt::format("it holds {} frames, and the run's index lists {}", moments.n_rows(), n_frames));
  return moments;
}

SegmentFrames read_frames(const Hdf5Reader& file, const Series& series, const std::int64_t n_frames) {
  SegmentFrames frames;
  frames.moments = read_frame_moments(file, n_frames);
  std::vector<double>* targets[] = {&frames.position, &frames.centreline, &frames.curvature};
  for (std::size_t e = 0; e < series.elements().size(); ++e) {
    const Series::Element& element = series.elements()[e];
    *targets[e] = file.read_reals(element.group + "/value", element.shape(frames.moments.n_rows()));
  }
  return frames;
}

}  // namespace

TrajectoryReader::TrajectoryReader(const RunFolder& folder, const SceneConfig& scene)
    : folder_(folder), output_(scene.output), first_frames_{0} {
  layout_.fibers = make_fibers(scene.fibers);
  const RunSummary summary = read_run_summary(folder.path());
  chain_ = summary.chain;
  for (const std::int64_t n_frames : summary.segment_frames) first_frames_.push_back(first_frames_.back() + n_frames);
}

std::filesystem::path TrajectoryReader::path_of(const std::size_t segment) const {
  return folder_.path() / segment_name(static_cast<std::int64_t>(segment));
}

void TrajectoryReader::for_each_frame(const std::function<void(const Frame&)>& visit) const {
  const Series series = make_frame_series(layout_, output_);
  double last_time = -std::numeric_limits<double>::infinity();
  for (std::size_t number = 0; number + 1 < first_frames_.size(); ++number) {
    const auto path = path_of(number);
    const Hdf5Reader file(path);
    check_is_listed(file, path, static_cast<std::int64_t>(number), chain_);
    const SegmentFrames frames = read_frames(file, series, first_frames_[number + 1] - first_frames_[number]);
    for (std::size_t row = 0; row < frames.moments.n_rows(); ++row) {
      const double time = frames.moments.time[row];
      if (!(time > last_time))
        file.reject("/particles/fibers/position/time",
                    fmt::format("its frame at {} comes after one at {}", time, last_time));
      last_time = time;
      visit(frames.frame(row));
    }
  }
}

Frame TrajectoryReader::read_frame(const std::int64_t number) const {
  SKEIN_REQUIRE(number >= 0 && number < n_frames(), fmt::format("frame {} of {}", number, n_frames()));
  const auto after = std::upper_bound(first_frames_.begin(), first_frames_.end(), number);
  const std::int64_t first = *(after - 1), segment = after - 1 - first_frames_.begin();
  const auto path = path_of(static_cast<std::size_t>(segment));
  const Hdf5Reader file(path);
  check_is_listed(file, path, segment, chain_);
  const SegmentFrames frames = read_frames(file, make_frame_series(layout_, output_), *after - first);
  return frames.frame(static_cast<std::size_t>(number - first));
}

std::vector<double> TrajectoryReader::read_times() const {
  std::vector<double> times;
  for (std::size_t number = 0; number + 1 < first_frames_.size(); ++number) {
    const auto path = path_of(number);
    const Hdf5Reader file(path);
    check_is_listed(file, path, static_cast<std::int64_t>(number), chain_);
    const Moments moments = read_frame_moments(file, first_frames_[number + 1] - first_frames_[number]);
    times.insert(times.end(), moments.time.begin(), moments.time.end());
  }
  return times;
}

}  // namespace skein
