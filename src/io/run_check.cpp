#include <skein/core/error.hpp>
#include <skein/io/checkpoint_folder.hpp>
#include <skein/io/folder_listing.hpp>
#include <skein/io/run_check.hpp>
#include <skein/io/run_leftovers.hpp>
#include <skein/io/run_scene.hpp>
#include <skein/io/start_file.hpp>
#include <skein/io/trajectory_end.hpp>
#include <skein/scene/recorded_times.hpp>

#include "hdf5_reader.hpp"
#include "segment_check.hpp"
#include "segment_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace skein {
namespace {

namespace fs = std::filesystem;

class RunChecker {
 public:
  explicit RunChecker(const RunFolder& folder)
      : folder_(folder),
        scene_(read_run_scene(folder)),
        layout_(make_layout(scene_)),
        frames_(make_frame_series(layout_, scene_.output)),
        records_(make_step_series(layout_)) {
    check_.checksum = checksum_of_first_scene(folder);
    record_times_.push_back(scene_.time.start);
    ends_[0] = {0, 0, 0, check_.checksum};
  }

  RunCheck check() {
    read_index();
    check_start();
    for (std::int64_t number = 0; number < n_segments_; ++number)
      if (!check_segment(number)) break;
    compare_with_index();
    try_to([this] { note_leftovers(); });
    try_to([this] { check_checkpoints(); });
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

  void note(std::string text) { check_.notes.push_back(std::move(text)); }

  void report(const Error& error, const std::string& remark = "") {
    std::string text = error.what() + remark;
    const auto& known = check_.problems;  // one folder may be looked into twice
    if (std::find(known.begin(), known.end(), text) != known.end()) return;
    check_.problems.push_back(std::move(text));
    if (error.code() == ExitCode::io_error) ++check_.unreadable;
  }

  /// What cannot be done is a problem, and the rest is checked all the same.
  template <class Action>
  void try_to(const Action& action) {
    try {
      action();
    } catch (const Error& error) {
      report(error);
    }
  }

  void read_index();
  void check_start();
  bool check_segment(std::int64_t number);
  void check_frames(const SegmentMoments& moments);
  void check_frame(const std::string& name, double time, std::int64_t step);
  void check_records(const SegmentMoments& moments);
  bool ends_at_earlier_end() const;
  void compare_with_index();
  void count_segments();
  void note_leftovers();
  void check_checkpoints();
  void check_checkpoint(std::int64_t number);
  void check_checkpoint_ahead(const fs::path& path, const TrajectoryEnd& end);

  RunFolder folder_;
  SceneConfig scene_;
  TrajectoryLayout layout_;
  Series frames_, records_;
  RunCheck check_;
  SegmentList listed_;           // by the index
  std::int64_t n_segments_ = 0;  // that are looked for: the listed ones or, without an index, those that are there
  std::string listed_checksum_;
  std::map<std::int64_t, TrajectoryEnd> ends_;  // after so many segments
  std::vector<double> record_times_;            // at index k: after k accepted steps
  double last_frame_time_ = 0.0;
};

void RunChecker::read_index() {
  try {
    const Hdf5Reader index(folder_.index());
    listed_ = read_segment_list(index);
    check_.status = index.text_attribute("/parameters", "status");
    n_segments_ = listed_.size();
    if (listed_.size() > 0) listed_checksum_ = index.text_attribute("/parameters/segments", "xxh3");
  } catch (const Error& error) {
    report(error, " 'skein resume' writes this file anew.");
    try_to([this] { count_segments(); });
  }
}

void RunChecker::check_start() {
  const StartConfig& start = scene_.start;
  if (start.checksum.empty()) return;
  check_.parent = fmt::format("'{}' at t = {}, step {}, certificate {}", start.parent, scene_.time.start, start.step,
                              start.certificate);
  try_to([this] { read_start(folder_.path(), scene_); });
}

// Where the index does not list them: those that follow each other from the first on.
void RunChecker::count_segments() {
  const auto names = list_names(folder_.segments());
  while (std::binary_search(names.begin(), names.end(), fs::path(segment_name(n_segments_)).filename().string()))
    ++n_segments_;
}

bool RunChecker::check_segment(const std::int64_t number) {
  SegmentMoments moments;
  const std::string name = segment_name(number);
  try {
    moments = read_segment_moments(folder_, number, frames_, records_);
  } catch (const Error& error) {
    report(error, " What follows it cannot be checked.");
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
  const bool is_listed = number < listed_.size();
  if (is_listed && (listed_.frames[number] != segment.n_frames || listed_.steps[number] != segment.n_records))
    report("'{}' holds {} frames and {} steps, and 'trajectory.h5' lists {} and {}", name, segment.n_frames,
           segment.n_records, listed_.frames[number], listed_.steps[number]);
  if (is_listed && segment.n_frames > 0 && listed_.last_time[number] != segment.last_time)
    report("'{}' ends at t = {}, and 'trajectory.h5' says {}", name, segment.last_time, listed_.last_time[number]);
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
  const double due = check_.frames == 0 ? scene_.time.start : find_next_frame(scene_, last_frame_time_);
  // A run that failed adds the last state it could reach.
  const bool is_last_state =
      (check_.status == "failed" || check_.status == "unknown") && time == record_times_.back() && time < due;
  if (time != due && !is_last_state)
    report("'{}': frame {} is at t = {} and should be at {}", name, check_.frames, time,
           std::isfinite(due) ? fmt::format("{}", due) : "no time: the frame before is at the scene's end");
  if (check_.frames > 0 && !(time > last_frame_time_))
    report("'{}': frame {} at t = {} comes after one at {}", name, check_.frames, time, last_frame_time_);
  const auto n_steps = static_cast<std::int64_t>(record_times_.size());
  const bool fits = step >= 0 && step < n_steps && record_times_[step] <= time &&
                    (step + 1 >= n_steps || time < record_times_[step + 1]);
  if (!fits) report("'{}': frame {} at t = {} does not follow step {}", name, check_.frames, time, step);
  last_frame_time_ = time;
  ++check_.frames;
}

bool RunChecker::ends_at_earlier_end() const {
  const auto& ends = scene_.time.earlier_ends;
  return last_frame_time_ == record_times_.back() &&
         std::find(ends.begin(), ends.end(), last_frame_time_) != ends.end();
}

void RunChecker::compare_with_index() {
  if (check_.segments < n_segments_) return;  // said already
  if (!listed_checksum_.empty() && listed_checksum_ != check_.checksum)
    report("'trajectory.h5' says that the chain of segments ends with {:.32}, and it ends with {}", listed_checksum_,
           check_.checksum);
  if (check_.status == "done" && ends_at_earlier_end())
    note(fmt::format("the run ended at t = {}, and its end was moved to {}: 'skein resume' goes on", last_frame_time_,
                     scene_.time.end));
  else if (check_.status == "done" && (last_frame_time_ != scene_.time.end || record_times_.back() != scene_.time.end))
    report(
        "the run says that it is done, but its last frame is at t = {}, its last step at {}, and the scene ends at {}",
        last_frame_time_, record_times_.back(), scene_.time.end);
  if (check_.status == "running")
    note(fmt::format("the run says that it is {}: if it is not, it was killed, and 'skein resume' goes on",
                     check_.status));
}

void RunChecker::note_leftovers() {
  for (const fs::path& path : find_leftovers(folder_, n_segments_))
    note(
        fmt::format("'{}' does not belong to the run; 'skein resume' removes it, and computes again "
                    "what it may hold",
                    path.string()));
}

void RunChecker::check_checkpoints() {
  const auto numbers = CheckpointFolder::list_numbers(folder_);
  for (const std::int64_t number : numbers) check_checkpoint(number);
  for (const std::string& name : list_names(folder_.checkpoints()))
    if (name.ends_with(".damaged")) note(fmt::format("'checkpoints/{}' is no longer used", name));
  if (!numbers.empty() || !holds_segments(folder_)) return;
  if (check_.status == "done")
    note(
        fmt::format("there is no checkpoint in '{}'; a run that is done does without", folder_.checkpoints().string()));
  else
    report("there is no checkpoint in '{}', though the run has frames: it cannot go on",
           folder_.checkpoints().string());
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
      return check_checkpoint_ahead(path, end);
    }
    if (found->second.checksum != end.checksum || found->second.frames != end.frames ||
        found->second.records != end.records)
      return report("checkpoint '{}' was made for another trajectory than this folder's", path.string());
    const double time = checkpoint.number("state.time");
    if (checkpoint.integer("state.step") != end.records || record_times_.at(end.records) != time)
      report("checkpoint '{}' is at t = {}, step {}; the trajectory it was made for ends at t = {}, step {}",
             path.string(), time, checkpoint.integer("state.step"), record_times_.at(end.records), end.records);
  } catch (const Error& error) {
    report(error);
  }
}

void RunChecker::check_checkpoint_ahead(const fs::path& path, const TrajectoryEnd& end) {
  try {
    check_trajectory(folder_, end, true);
  } catch (const Error& error) {
    report(Error(error.code(), fmt::format("checkpoint '{}': {}", path.string(), error.what())));
  }
}

}  // namespace

RunCheck check_run(const fs::path& path) {
  const RunFolder folder = RunFolder::open_begun(path);
  try {
    check_scene_is_of_run(folder);
  } catch (const Error& error) {  // whatever the scene is compared with would seem wrong
    if (error.code() != ExitCode::damaged_data) throw;
    RunCheck check;
    check.problems.push_back(error.what());
    return check;
  }
  return RunChecker(folder).check();
}

}  // namespace skein
