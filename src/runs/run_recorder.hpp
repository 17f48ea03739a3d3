#pragma once

#include <skein/analysis/regime.hpp>
#include <skein/io/trajectory_writer.hpp>
#include <skein/scene/scene_config.hpp>
#include <skein/solvers/integrator.hpp>

#include "runs/model_guard.hpp"
#include "runs/run_ledger.hpp"
#include "runs/run_messages.hpp"

#include <string>
#include <vector>

namespace skein {

/// Writes down what happens in a run: frames at their times, the small numbers of each step, changes of regime, and
/// warnings where the model resolves no more.
class RunRecorder {
 public:
  /// All of them must outlive the recorder. @param start  behind which the trajectory goes on
  RunRecorder(const SceneConfig& scene, const RunFolder& folder, const Physics& physics, const TrajectoryEnd& start,
              RunLedger& ledger, RunMessages& messages);

  /// The next frame's number, crossings so far, and what the guard has met.
  void visit_memory(MemoryVisitor& visitor);

  /// The first frame, or what the frame before says where a run goes on.
  void begin(const State& state);

  /// The numbers of an accepted step, and the frames that are due in it.
  void record(const State& state, const StepReport& report, const Integrator& integrator);

  /// The state of a run that failed, as a frame of its own, unless it is there already.
  void record_last_good(const State& state);

  /// What was met beyond the model in the whole run; empty where nothing was.
  std::string describe_limits() const { return guard_.describe(); }

  TrajectoryWriter& trajectory() { return trajectory_; }

 private:
  void write_frames_in_step(const State& state, const Integrator& integrator);
  void write_frame(std::int64_t step, double time, const ConstVectors& position);
  void note_regimes(const Frame& frame);
  void write_step_record(const State& state, const StepReport& report);

  const SceneConfig& scene_;
  const Physics& physics_;
  RunLedger& ledger_;
  RunMessages& messages_;
  TrajectoryWriter trajectory_;
  ModelGuard guard_;
  Vectors frame_position_;
  std::int64_t next_frame_ = 0;
  double time_ = 0.0;             ///< up to which frames were looked for
  std::vector<Regime> regimes_;   ///< [n_fibers], of the last frame
  std::vector<Vec3> centreline_;  ///< [n_sections], of the last step, length
  std::int64_t crossings_ = 0;    ///< since the start of the run
};

}  // namespace skein
