#include <skein/core/error.hpp>
#include <skein/core/stopwatch.hpp>
#include <skein/io/atomic_file.hpp>
#include <skein/io/run_leftovers.hpp>
#include <skein/io/trajectory_writer.hpp>

#include "segment.hpp"
#include "series.hpp"
#include "trajectory_index.hpp"
#include "xdmf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>
#include <vector>

namespace skein {
namespace {

// Of a run whose segments were moved away, and which starts again.
void make_folder_of_segments(const RunFolder& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder.segments(), error);
  if (error)
    throw Error(ExitCode::io_error,
                fmt::format("cannot create '{}' (0 bytes written): {}.", folder.segments().string(), error.message()));
}

}  // namespace

struct TrajectoryWriter::Parts {
  Parts(const RunFolder& run_folder, TrajectoryLayout run_layout, const OutputConfig& output,
        const SegmentLimits segment_limits)
      : folder(run_folder),
        layout(std::move(run_layout)),
        limits(segment_limits),
        frames(make_frame_series(layout, output)),
        records(make_step_series(layout)),
        xdmf(layout.fibers, output),
        checksum(checksum_of_first_scene(folder)) {}

  RunFolder folder;
  TrajectoryLayout layout;
  SegmentLimits limits;
  Series frames;
  Series records;
  XdmfText xdmf;
  std::vector<Segment> segments;
  std::string checksum;  // end of the chain
  std::string status = "running";
  bool index_is_old = true;
  bool begun = false;  // until then nothing in the folder is changed
  bool failed = false;
  WallClock::time_point last_close = WallClock::now();
  double seconds_of_close = 0.0;
  double seconds = 0.0;
  std::uint64_t bytes = 0;

  void read_up_to(const TrajectoryEnd& end);
  void save();
  void write_segment_file();
  void save_when_due();
};

void TrajectoryWriter::Parts::read_up_to(const TrajectoryEnd& end) {
  check_trajectory(folder, end, false);
  double last_time = std::numeric_limits<double>::quiet_NaN();
  for (std::int64_t number = 0; number < end.segments; ++number) {
    SegmentLabel label = read_segment_label(folder, number, false);
    if (label.segment.n_frames > 0) {
      last_time = label.segment.last_time;
      frames.set_last_moment(label.frames.step.back(), last_time);
    }
    if (label.segment.n_records > 0) records.set_last_moment(label.records.step.back(), label.records.time.back());
    label.segment.last_time = last_time;
    xdmf.add_frames(label.segment, label.frames.time);
    checksum = label.segment.checksum;
    segments.push_back(std::move(label.segment));
  }
}

// On an error the buffers and index_is_old still say what is left to do.
void TrajectoryWriter::Parts::save() {
  SKEIN_REQUIRE(begun, "a trajectory begins before anything of it is saved");
  const WallClock::time_point start = WallClock::now();
  failed = true;
  write_segment_file();
  if (index_is_old) {
    bytes += write_trajectory_index(folder, layout, frames, records, segments, status);
    if (status != "running" || xdmf.has_grown()) bytes += xdmf.write(folder);
    index_is_old = false;
  }
  failed = false;
  last_close = WallClock::now();
  seconds_of_close = seconds_since(start);
}

void TrajectoryWriter::Parts::write_segment_file() {
  if (frames.n_rows() == 0 && records.n_rows() == 0) return;
  Segment segment;
  segment.last_time = std::numeric_limits<double>::quiet_NaN();
  if (!segments.empty()) {
    const Segment& previous = segments.back();
    segment.number = previous.number + 1;
    segment.first_frame = previous.first_frame + previous.n_frames;
    segment.first_record = previous.first_record + previous.n_records;
    segment.last_time = previous.last_time;
  }
  bytes += write_segment(folder, frames, records, checksum, segment);
  checksum = segment.checksum;
  xdmf.add_frames(segment, frames.times());
  segments.push_back(std::move(segment));
  frames.clear();
  records.clear();
  index_is_old = true;
}

void TrajectoryWriter::Parts::save_when_due() {
  const double interval = std::max(limits.seconds, seconds_of_close / limits.largest_share);
  if (frames.n_bytes() + records.n_bytes() >= limits.bytes || seconds_since(last_close) >= interval) save();
}

TrajectoryWriter::TrajectoryWriter(const RunFolder& folder, TrajectoryLayout layout, const OutputConfig& output,
                                   const SegmentLimits limits) {
  SKEIN_REQUIRE(layout.blobs.size() == static_cast<std::size_t>(count_nodes(layout.fibers)), "one blob for each node");
  parts_ = std::make_unique<Parts>(folder, std::move(layout), output, limits);
  const Stopwatch stopwatch(parts_->seconds);
  parts_->begun = true;
  parts_->save();
}

TrajectoryWriter::TrajectoryWriter(const RunFolder& folder, TrajectoryLayout layout, const OutputConfig& output,
                                   const TrajectoryEnd& end, const SegmentLimits limits) {
  parts_ = std::make_unique<Parts>(folder, std::move(layout), output, limits);
  const Stopwatch stopwatch(parts_->seconds);
  parts_->read_up_to(end);
}

void TrajectoryWriter::begin() {
  const Stopwatch stopwatch(parts_->seconds);
  const auto n_segments = static_cast<std::int64_t>(parts_->segments.size());
  const RunFolder& folder = parts_->folder;
  find_leftovers(folder, n_segments);  // all folders can be listed
  make_folder_of_segments(folder);
  // The index first: whoever reads must not be sent to segments that are gone.
  parts_->begun = true;
  parts_->save();
  remove_leftovers(folder, n_segments);
  std::error_code ignored;  // the next frames replace it
  if (end().frames == 0) std::filesystem::remove(folder.xdmf(), ignored);
}

TrajectoryEnd TrajectoryWriter::end() const {
  TrajectoryEnd end;
  end.checksum = parts_->checksum;
  if (parts_->segments.empty()) return end;
  const Segment& last = parts_->segments.back();
  end.segments = last.number + 1;
  end.frames = last.first_frame + last.n_frames;
  end.records = last.first_record + last.n_records;
  return end;
}

TrajectoryWriter::~TrajectoryWriter() {
  if (parts_->failed || !parts_->begun) return;
  try {
    parts_->save();
  } catch (...) {  // finish() would have told
  }
}

void TrajectoryWriter::append(const Frame& frame) {
  const Stopwatch stopwatch(parts_->seconds);
  skein::append(parts_->frames, frame);
  parts_->save_when_due();
}

void TrajectoryWriter::append(const StepRecord& record) {
  const Stopwatch stopwatch(parts_->seconds);
  skein::append(parts_->records, record);
  parts_->save_when_due();
}

void TrajectoryWriter::close_segment() {
  const Stopwatch stopwatch(parts_->seconds);
  parts_->save();
}

void TrajectoryWriter::finish(const std::string& status) {
  const Stopwatch stopwatch(parts_->seconds);
  parts_->index_is_old = parts_->index_is_old || parts_->status != status;
  parts_->status = status;
  parts_->save();
}

std::uint64_t TrajectoryWriter::bytes_written() const { return parts_->bytes; }
double TrajectoryWriter::seconds_spent() const { return parts_->seconds; }

}  // namespace skein
