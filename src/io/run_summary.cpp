#include <skein/core/error.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/io/run_summary.hpp>

#include "hdf5_reader.hpp"
#include "segment.hpp"

#include <fmt/format.h>

#include <limits>
#include <numeric>

namespace skein {
namespace {

std::int64_t sum(const std::vector<std::int64_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

}  // namespace

RunSummary read_run_summary(const std::filesystem::path& path) {
  const RunFolder folder = RunFolder::open(path);
  const Hdf5Reader index(folder.index());
  const auto frames = index.read_integers("/parameters/segments/frames");
  const auto steps = index.read_integers("/parameters/segments/steps");
  const auto last_time = index.read_reals("/parameters/segments/last_time");
  if (steps.size() != frames.size() || last_time.size() != frames.size())
    throw Error(ExitCode::damaged_data,
                fmt::format("the list of segments in '{}' is damaged.", folder.index().string()));
  for (std::size_t number = 0; number < frames.size(); ++number) {
    const auto segment = path / segment_name(static_cast<std::int64_t>(number));
    std::error_code ignored;
    if (!std::filesystem::exists(segment, ignored))
      throw Error(ExitCode::damaged_data, fmt::format("'{}' is gone: its frames are lost.", segment.string()));
  }

  RunSummary summary;
  if (index.has_attribute("/parameters", "title")) summary.title = index.text_attribute("/parameters", "title");
  summary.status = index.text_attribute("/parameters", "status");
  summary.frames = sum(frames);
  summary.steps = sum(steps);
  summary.segments = static_cast<std::int64_t>(frames.size());
  summary.last_time = last_time.empty() ? std::numeric_limits<double>::quiet_NaN() : last_time.back();
  return summary;
}

}  // namespace skein
