#include <skein/core/error.hpp>
#include <skein/io/trajectory_end.hpp>

#include "segment.hpp"

#include <fmt/format.h>

namespace skein {
namespace {

SegmentLabel read_label(const RunFolder& folder, const std::int64_t number, const bool check_seal) {
  try {
    return read_segment_label(folder, number, check_seal);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("its trajectory is broken: {}", error.what()));
  }
}

}  // namespace

TrajectoryEnd find_trajectory_start(const RunFolder& folder) { return {0, 0, 0, checksum_of_first_scene(folder)}; }

void write_trajectory_end(Checkpoint& checkpoint, const TrajectoryEnd& end) {
  using Integers = std::vector<std::int64_t>;
  checkpoint.set("trajectory.segments", Integers{end.segments});
  checkpoint.set("trajectory.frames", Integers{end.frames});
  checkpoint.set("trajectory.records", Integers{end.records});
  checkpoint.set("trajectory.xxh3", end.checksum);
}

TrajectoryEnd read_trajectory_end(const Checkpoint& checkpoint) {
  return {checkpoint.integer("trajectory.segments"), checkpoint.integer("trajectory.frames"),
          checkpoint.integer("trajectory.records"), checkpoint.text("trajectory.xxh3")};
}

void check_trajectory(const RunFolder& folder, const TrajectoryEnd& end, const bool check_seals) {
  std::string checksum = checksum_of_first_scene(folder);
  std::int64_t n_frames = 0, n_records = 0;
  for (std::int64_t number = 0; number < end.segments; ++number) {
    const SegmentLabel label = read_label(folder, number, check_seals);
    if (label.segment.number != number || label.previous_checksum != checksum ||
        label.segment.first_frame != n_frames || label.segment.first_record != n_records)
      throw Error(
          ExitCode::damaged_data,
          fmt::format("its trajectory is broken: '{}' does not follow the segment before", segment_name(number)));
    n_frames += label.segment.n_frames;
    n_records += label.segment.n_records;
    checksum = label.segment.checksum;
  }
  if (n_frames != end.frames || n_records != end.records || checksum != end.checksum)
    throw Error(
        ExitCode::damaged_data,
        fmt::format("its trajectory has {} frames and {} steps in {} segments (xxh3 {}), this folder's {} and {} ({})",
                    end.frames, end.records, end.segments, end.checksum, n_frames, n_records, checksum));
}

}  // namespace skein
