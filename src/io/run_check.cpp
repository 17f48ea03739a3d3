#include <skein/core/error.hpp>
#include <skein/io/checkpoint_folder.hpp>
#include <skein/io/run_check.hpp>
#include <skein/io/trajectory_end.hpp>
#include <skein/scene/frame_times.hpp>
#include <skein/scene/scene_file.hpp>

#include "hdf5_reader.hpp"
#include "segment_check.hpp"
#include "segment_list.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

namespace skein {
namespace {

namespace fs = std::filesystem;

class RunChecker {
 public:
  explicit RunChecker(const RunFolder& folder)
      : folder_(folder),
        scene_(read_scene(folder.scene(), {}).config),
        layout_(make_layout(scene_)),
        frames_(make_frame_series(layout_, scene_.output)),
        records_(make_step_series(layout_)) {
    check_.checksum = checksum_of_file(folder.scene());
    ends_[0] = {0, 0, 0, check_.checksum};
  }

  RunCheck check() {
    read_index();
    for (std::int64_t number = 0; number < listed_.size(); ++number)
      if (!check_segment(number)) break;
    compare_with_index();
    check_unlisted_segments();
    check_checkpoints();
    check_.last_time = last_frame_time_;
    return check_;
  }

 private:
  static TrajectoryLayout make_layout(const SceneConfig& scene) {
    TrajectoryLayout layout;
    layout.fibers = make_fibers(scene.fibers);
    return layout;
  }

  template <class... Values>
  void report(fmt::format_string<Values...> text, Values&&... values) {
    check_.problems.push_back(fmt::format(text, std::forward<Values>(values)...));
  }

  void read_index();
  bool check_segment(std::int64_t number);
  void check_frames(const SegmentMoments& moments);
  void check_frame(const std::string& name, double time, std::int64_t step);
  void check_records(const SegmentMoments& moments);
  void compare_with_index();
  void check_unlisted_segments();
  void check_checkpoints();
  void check_checkpoint(std::int64_t number);

  RunFolder folder_;
  SceneConfig scene_;
  TrajectoryLayout layout_;
  Series frames_, records_;
  RunCheck check_;
  SegmentList listed_;  // by the index
  std::string listed_checksum_;
  std::map<std::int64_t, TrajectoryEnd> ends_;  // after so many segments
  std::vector<double> record_times_{0.0};       // at index k: after k accepted steps
  double last_frame_time_ = 0.0;
};

void RunChecker::read_index() {
  try {
    const Hdf5Reader index(folder_.index());
    listed_ = read_segment_list(index);
    check_.status = index.text_attribute("/parameters", "status");
    if (listed_.size() > 0) listed_checksum_ = index.text_attribute("/parameters/segments", "xxh3");
  } catch (const Error& error) {
    check_.problems.push_back(error.what());
  }
}

bool RunChecker::check_segment(const std::int64_t number) {
  SegmentMoments moments;
  const std::string name = segment_name(number);
  try {
    moments = read_segment_moments(folder_, number, frames_, records_);
  } catch (const Error& error) {
    report("{} What follows it cannot be checked.", error.what());
    return false;
  }
  const Segment& segment = moments.label.segment;
  if (segment.number != number) report("'{}' says that it is segment {}", name, segment.number);
  if (moments.label.previous_checksum != check_.checksum)
    report("'{}' does not follow the one before: the chain says {}, it says {}", name, check_.checksum,
           moments.label.previous_checksum);
  if (segment.checksum != moments.checksum)
    report("'{}' was changed: its contents have the xxh3 {}, its label says {}", name, moments.checksum,
           segment.checksum);
  if (listed_.frames[number] != segment.n_frames || listed_.steps[number] != segment.n_records)
    report("'{}' holds {} frames and {} steps, and the index lists {} and {}", name, segment.n_frames,
           segment.n_records, listed_.frames[number], listed_.steps[number]);
  if (segment.n_frames > 0 && listed_.last_time[number] != segment.last_time)
    report("'{}' ends at t = {}, and the index says {}", name, segment.last_time, listed_.last_time[number]);
  if (segment.first_frame != check_.frames)
    report("'{}' begins with frame {}, and frame {} comes next", name, segment.first_frame, check_.frames);
  if (segment.first_record != check_.records)
    report("'{}' begins with step record {}, and {} comes next", name, segment.first_record, check_.records);
  check_records(moments);
  check_frames(moments);
  check_.checksum = segment.checksum;
  ++check_.segments;
  ends_[check_.segments] = {check_.segments, check_.frames, check_.records, check_.checksum};
  return true;
}

void RunChecker::check_records(const SegmentMoments& moments) {
  const std::string name = segment_name(moments.label.segment.number);
  for (std::size_t i = 0; i < moments.label.records.time.size(); ++i) {
    ++check_.records;
    const double before = record_times_.back(), time = moments.label.records.time[i], dt = moments.record_dt[i];
    if (moments.label.records.step[i] != check_.records)
      report("'{}': step {} is recorded where step {} should be", name, moments.label.records.step[i], check_.records);
    const bool is_sum = time == before + dt || dt == time - before;  // the latter where an end cut it
    if (!is_sum || !(dt > 0.0))
      report("'{}': step {} ends at t = {}, which is not {} + its dt {}", name, check_.records, time, before, dt);
    record_times_.push_back(time);
  }
}

void RunChecker::check_frames(const SegmentMoments& moments) {
  const Moments& frames = moments.label.frames;
  for (std::size_t i = 0; i < frames.time.size(); ++i)
    check_frame(segment_name(moments.label.segment.number), frames.time[i], frames.step[i]);
}

void RunChecker::check_frame(const std::string& name, const double time, const std::int64_t step) {
  const double due = find_frame_time(scene_, check_.frames);
  // A run that failed adds the last state it could reach.
  const bool is_last_state = check_.status == "failed" && time == record_times_.back() && time < due;
  if (time != due && !is_last_state)
    report("'{}': frame {} is at t = {} and should be at {}", name, check_.frames, time, due);
  if (check_.frames > 0 && !(time > last_frame_time_))
    report("'{}': frame {} at t = {} comes after one at {}", name, check_.frames, time, last_frame_time_);
  const auto n_steps = static_cast<std::int64_t>(record_times_.size());
  const bool fits = step >= 0 && step < n_steps && record_times_[step] <= time &&
                    (step + 1 >= n_steps || time < record_times_[step + 1]);
  if (!fits) report("'{}': frame {} at t = {} does not follow step {}", name, check_.frames, time, step);
  last_frame_time_ = time;
  ++check_.frames;
}

void RunChecker::compare_with_index() {
  if (check_.segments < listed_.size()) return;  // said already
  if (listed_.size() > 0 && listed_checksum_ != check_.checksum)
    report("the index says that the chain ends with {}, the segments say {}", listed_checksum_, check_.checksum);
  if (check_.status == "done" && (last_frame_time_ != scene_.time.end || record_times_.back() != scene_.time.end))
    report(
        "the run says that it is done, but its last frame is at t = {}, its last step at {}, and the scene ends at {}",
        last_frame_time_, record_times_.back(), scene_.time.end);
  if (check_.status == "running")
    check_.notes.emplace_back(
        "the run says that it is running: if it is not, it was killed, and 'skein resume' goes on");
}

void RunChecker::check_unlisted_segments() {
  std::set<std::string> listed;
  for (std::int64_t number = 0; number < listed_.size(); ++number) listed.insert(segment_name(number));
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_.segments(), ignored)) {
    const std::string name = "segments/" + entry.path().filename().string();
    if (listed.count(name) == 0)
      check_.notes.push_back(
          fmt::format("'{}' is not in the index; 'skein resume' removes it and computes it again", name));
  }
}

void RunChecker::check_checkpoints() {
  for (const std::int64_t number : CheckpointFolder::list_numbers(folder_)) check_checkpoint(number);
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_.checkpoints(), ignored)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".partial" || extension == ".damaged")
      check_.notes.push_back(fmt::format("'checkpoints/{}' is no longer used", entry.path().filename().string()));
  }
}

void RunChecker::check_checkpoint(const std::int64_t number) {
  const fs::path path = CheckpointFolder::path_of(folder_, number);
  try {
    const Checkpoint checkpoint = read_checkpoint(path);
    ++check_.checkpoints;
    if (checkpoint.text("scene.xxh3") != ends_[0].checksum)
      return report("checkpoint '{}' belongs to another scene", path.string());
    const TrajectoryEnd end = read_trajectory_end(checkpoint);
    const auto found = ends_.find(end.segments);
    if (found == ends_.end()) {
      // A segment that the index does not list yet is no damage: the checkpoint says whether it is whole.
      const std::string fault = find_missing_segments(folder_, end, true);
      if (!fault.empty()) report("checkpoint '{}': {}", path.string(), fault);
      return;
    }
    if (found->second.checksum != end.checksum || found->second.frames != end.frames ||
        found->second.records != end.records)
      return report("checkpoint '{}' was made for another trajectory than this folder's", path.string());
    const double time = checkpoint.number("state.time");
    if (checkpoint.integer("state.step") != end.records || record_times_.at(end.records) != time)
      report("checkpoint '{}' is at t = {}, step {}; the trajectory it was made for ends at t = {}, step {}",
             path.string(), time, checkpoint.integer("state.step"), record_times_.at(end.records), end.records);
  } catch (const Error& error) {
    check_.problems.push_back(error.what());
  }
}

}  // namespace

RunCheck check_run(const fs::path& folder) { return RunChecker(RunFolder::open(folder)).check(); }

}  // namespace skein
