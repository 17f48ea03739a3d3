#include "runs/run_recorder.hpp"

#include <skein/analysis/crossing.hpp>
#include <skein/io/read_file.hpp>
#include <skein/scene/recorded_times.hpp>

#include "runs/observables.hpp"
#include "runs/run_description.hpp"

#include <fmt/format.h>

#include <utility>

namespace skein {
namespace {

/// Adds the wall time it lived, less what the trajectory's writer counts itself, to a sum.
class StopwatchBesideTrajectory {
 public:
  StopwatchBesideTrajectory(double& sum, const TrajectoryWriter& trajectory)
      : sum_(sum), trajectory_(trajectory), in_trajectory_(trajectory.seconds_spent()) {}
  ~StopwatchBesideTrajectory() { sum_ += seconds_since(start_) - (trajectory_.seconds_spent() - in_trajectory_); }
  StopwatchBesideTrajectory(const StopwatchBesideTrajectory&) = delete;
  StopwatchBesideTrajectory& operator=(const StopwatchBesideTrajectory&) = delete;

 private:
  double& sum_;
  const TrajectoryWriter& trajectory_;
  double in_trajectory_;
  WallClock::time_point start_ = WallClock::now();
};

}  // namespace

RunRecorder::RunRecorder(const SceneConfig& scene, const RunFolder& folder, const Physics& physics,
                         const TrajectoryEnd& start, RunLedger& ledger, RunMessages& messages)
    : scene_(scene),
      physics_(physics),
      ledger_(ledger),
      messages_(messages),
      trajectory_(folder, describe_layout(scene, read_file(folder.scene()), physics.fibers), scene.output, start),
      guard_(physics.fibers, physics.has_force_between_fibers()),
      frame_position_("skein::RunRecorder::frame_position", physics.blob.extent(0)) {}

void RunRecorder::visit_memory(MemoryVisitor& visitor) {
  visitor.integer("run.next_frame", next_frame_);
  visitor.integer("run.crossings", crossings_);
  guard_.visit_memory(visitor);
}

void RunRecorder::begin(const State& state) {
  time_ = state.time;
  centreline_ = physics_.sections.compute_centreline(state.position);
  if (next_frame_ == 0) {
    write_frame(0, state.time, state.position);
    next_frame_ = 1;
  } else {
    regimes_ = classify_frame(physics_.fibers, make_frame(physics_, state.step, state.time, state.position));
  }
}

void RunRecorder::record(const State& state, const StepReport& report, const Integrator& integrator) {
  {
    const StopwatchBesideTrajectory stopwatch(ledger_.parts().observables, trajectory_);
    write_step_record(state, report);
  }
  const StopwatchBesideTrajectory stopwatch(ledger_.parts().frames, trajectory_);
  write_frames_in_step(state, integrator);
}

void RunRecorder::write_frames_in_step(const State& state, const Integrator& integrator) {
  for (double due = find_next_frame(scene_, time_); due <= state.time; due = find_next_frame(scene_, due)) {
    if (due == state.time) {
      write_frame(state.step, state.time, state.position);
    } else {
      integrator.interpolate(due, frame_position_);
      write_frame(state.step - 1, due, frame_position_);
    }
    ++next_frame_;
  }
  time_ = state.time;
}

void RunRecorder::record_last_good(const State& state) {
  if (!is_frame_time(scene_, state.time)) write_frame(state.step, state.time, state.position);
}

void RunRecorder::write_frame(const std::int64_t step, const double time, const ConstVectors& position) {
  const Frame frame = make_frame(physics_, step, time, position);
  trajectory_.append(frame);
  note_regimes(frame);
  messages_.listener().receive(frame);
}

void RunRecorder::note_regimes(const Frame& frame) {
  const auto regimes = classify_frame(physics_.fibers, frame);
  for (std::size_t f = 0; f < regimes.size() && !regimes_.empty(); ++f) {
    if (regimes[f] == regimes_[f]) continue;
    messages_.events().write("regime", {{"time", frame.time},
                                        {"fiber", static_cast<std::int64_t>(f)},
                                        {"regime", std::string(name_of(regimes[f]))},
                                        {"before", std::string(name_of(regimes_[f]))}});
    messages_.note(fmt::format("t = {:.6g}: fiber {} is in regime {}, was in {}", frame.time, f, name_of(regimes[f]),
                               name_of(regimes_[f])));
  }
  regimes_ = regimes;
}

void RunRecorder::write_step_record(const State& state, const StepReport& report) {
  StepMeasures measures = physics_.measure(state.time, state.position);
  StepRecord record = make_step_record(physics_, state, report, measures);
  crossings_ += count_crossings(physics_.fibers, centreline_, measures.sections.centreline);
  centreline_ = std::move(measures.sections.centreline);
  record.crossings = crossings_;
  record.evaluations = ledger_.evaluations();
  record.estimated_error = ledger_.estimated_error();
  const ErrorRecord errors = physics_.mobility->error_record();
  record.velocity_error = errors.last;
  record.fmm_order = errors.order;
  record.fmm_misses = errors.n_misses;
  trajectory_.append(record);
  for (const std::string& warning : guard_.look(record, measures.largest_strain)) {
    messages_.say(warning);
    messages_.events().write("warning", {{"time", state.time}, {"step", state.step}, {"message", warning}});
  }
}

}  // namespace skein
