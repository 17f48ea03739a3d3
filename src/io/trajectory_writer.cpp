#include <skein/io/trajectory_writer.hpp>

#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>

#include "segment.hpp"
#include "series.hpp"
#include "trajectory_index.hpp"
#include "xdmf.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>
#include <vector>

namespace skein {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(const Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Adds the time it lived to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum), start_(Clock::now()) {}
  ~Stopwatch() { sum_ += seconds_since(start_); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sum_;
  Clock::time_point start_;
};

std::string checksum_of_file(const std::filesystem::path& path) {
  Checksum checksum;
  checksum.add(read_file(path));
  return checksum.text();
}

}  // namespace

struct TrajectoryWriter::Parts {
  RunFolder folder;
  TrajectoryLayout layout;
  SegmentLimits limits;
  Series frames;
  Series records;
  XdmfText xdmf;
  std::vector<Segment> segments = {};
  std::string checksum = {};  // end of the chain
  std::string status = "running";
  bool index_is_old = true;
  bool failed = false;
  Clock::time_point last_close = Clock::now();
  double seconds_of_close = 0.0;
  double seconds = 0.0;
  std::uint64_t bytes = 0;

  void save();
  void write_segment_file();
  void save_when_due();
};

// On an error the buffers and index_is_old still say what is left to do.
void TrajectoryWriter::Parts::save() {
  const Clock::time_point start = Clock::now();
  failed = true;
  write_segment_file();
  if (index_is_old) {
    bytes += write_trajectory_index(folder, layout, frames, records, segments, status);
    bytes += xdmf.write(folder);
    index_is_old = false;
  }
  failed = false;
  last_close = Clock::now();
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
  Series frames = make_frame_series(layout, output);
  Series records = make_step_series(layout);
  XdmfText xdmf(layout.fibers, output);
  parts_.reset(new Parts{folder, std::move(layout), limits, std::move(frames), std::move(records), std::move(xdmf)});
  const Stopwatch stopwatch(parts_->seconds);
  parts_->checksum = checksum_of_file(folder.scene());
  parts_->save();
}

TrajectoryWriter::~TrajectoryWriter() {
  if (parts_->failed) return;
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
