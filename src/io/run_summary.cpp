#include <skein/core/error.hpp>
#include <skein/io/folder_listing.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/io/run_summary.hpp>

#include "scene_in_index.hpp"
#include "segment_list.hpp"

#include <fmt/format.h>

#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace skein {
namespace {

std::int64_t sum(const std::vector<std::int64_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

}  // namespace

RunSummary read_run_summary(const std::filesystem::path& path) {
  const RunFolder folder = RunFolder::open(path);
  const Hdf5Reader index(folder.index());
  compare_with_scene_in_index(folder, index);
  SegmentList list = read_segment_list(index);
  for (std::int64_t number = 0; number < list.size(); ++number) {
    const auto segment = path / segment_name(number);
    if (!is_there(segment))
      throw Error(ExitCode::damaged_data, fmt::format("'{}' is gone: its frames are lost.", segment.string()));
    check_is_file(segment);
  }

  RunSummary summary;
  if (index.has_attribute("/parameters", "title")) summary.title = index.text_attribute("/parameters", "title");
  if (index.has_attribute("/parameters/segments", "chain"))
    summary.chain = index.text_attribute("/parameters/segments", "chain");
  summary.status = index.text_attribute("/parameters", "status");
  summary.frames = sum(list.frames);
  summary.steps = sum(list.steps);
  summary.segments = list.size();
  summary.certificate =
      list.size() == 0 ? checksum_of_first_scene(folder) : index.text_attribute("/parameters/segments", "xxh3");
  summary.last_time = list.last_time.empty() ? std::numeric_limits<double>::quiet_NaN() : list.last_time.back();
  summary.segment_frames = std::move(list.frames);
  return summary;
}

}  // namespace skein
