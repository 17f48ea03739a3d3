#pragma once

#include <skein/analysis/regime.hpp>
#include <skein/core/error.hpp>
#include <skein/core/stopwatch.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/io/checkpoint_folder.hpp>
#include <skein/io/event_log.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/io/run_log.hpp>
#include <skein/io/trajectory_writer.hpp>
#include <skein/scene/scene_config.hpp>
#include <skein/solvers/integrator.hpp>

#include "runs/cost_card.hpp"
#include "runs/fault_injection.hpp"
#include "runs/model_guard.hpp"
#include "runs/progress.hpp"
#include "runs/run_control.hpp"
#include "runs/watched_dynamics.hpp"

#include <memory>
#include <string>

namespace skein {

/// Wires the layers into one run of one scene. Nothing else does.
class Simulation {
 public:
  /// @param folder      holds the scene's text; whatever a trajectory in it has behind the checkpoint is removed
  /// @param checkpoint  where the run goes on; null: it starts at t = 0
  Simulation(const SceneConfig& scene, const RunFolder& folder, const Checkpoint* checkpoint, RunControl& control,
             ProgressReport::Kind progress, bool quiet);

  /// Says, on stderr and in run.log, what is going to be computed, how, and what it will take.
  void introduce();

  /// On stderr and in run.log.
  void say(const std::string& text);

  /// To the end of the scene, or until it is asked to stop, with a checkpoint in either case.
  /// @throws Error(numerical) after saving the last good state as a checkpoint and as a frame.
  ExitCode run();

 private:
  /// Counts over all processes that took part in the run, up to the last accepted step.
  struct Counters {
    std::int64_t evaluations = 0, rejected = 0, next_frame = 0;
    double pairs = 0.0, seconds = 0.0;
    double estimated_error = 0.0;  ///< sum of the steps' estimates, root mean square over nodes, length
    void visit_memory(MemoryVisitor& visitor);
  };

  void restore(const Checkpoint& checkpoint);
  void advance_to_end();
  void take_step();
  StepReport advance();
  void count(const StepReport& report);
  bool checkpoint_is_due(double time_before) const;
  void save_checkpoint();
  void save_last_good_state(const Error& error);
  void write_frames_up_to(double time);
  void note_regimes(const Frame& frame);
  void write_frame(std::int64_t step, double time, const ConstVectors& position);
  void record_step(const StepReport& report);
  void report_end(ExitCode code);
  CostCard make_cost_card() const;
  void say_cost(const CostCard& card);
  double seconds_of_run() const;

  WallClock::time_point start_ = WallClock::now();  // first: setting up counts
  SceneConfig scene_;
  RunFolder folder_;
  RunControl& control_;
  std::vector<Fiber> fibers_;
  FaultOrder fault_order_;
  CurrentStep current_step_;
  FiberDynamics dynamics_;
  FaultyDynamics faulty_dynamics_;
  WatchedDynamics watched_dynamics_;
  State state_;
  std::unique_ptr<Integrator> integrator_;
  RunLog log_;
  EventLog events_;
  TrajectoryWriter trajectory_;
  CheckpointFolder checkpoints_;
  ProgressReport progress_;
  Vectors frame_position_;
  std::vector<Regime> regimes_;  ///< [n_fibers], of the last frame

  Counters counters_, counters_at_start_;
  ModelGuard guard_;
  std::int64_t spare_evaluations_ = 0;  ///< that measured their own cost, and their pairs
  double spare_pairs_ = 0.0;
  FiberDynamics::Seconds spare_seconds_;
  double direct_seconds_ = 0.0;  ///< that a direct sum would take, estimated; 0 where that is the method
  std::int64_t steps_at_start_ = 0, step_of_checkpoint_ = -1;
  WallClock::time_point last_checkpoint_;
  double step_seconds_ = 0.0, integration_seconds_ = 0.0, observables_seconds_ = 0.0, frame_seconds_ = 0.0,
         checkpoint_seconds_ = 0.0, largest_error_ = 0.0;
  std::uint64_t checkpoint_bytes_ = 0;
  bool quiet_;
};

}  // namespace skein
