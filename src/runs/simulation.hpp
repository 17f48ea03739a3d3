#pragma once

#include <skein/core/error.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/physics/sum_team.hpp>
#include <skein/scene/scene_config.hpp>

#include "runs/checkpoint_keeper.hpp"
#include "runs/run_control.hpp"
#include "runs/run_hooks.hpp"
#include "runs/run_ledger.hpp"
#include "runs/run_listener.hpp"
#include "runs/run_messages.hpp"
#include "runs/run_recorder.hpp"
#include "runs/watched_dynamics.hpp"

#include <memory>
#include <string>

namespace skein {

/// One run of one scene in one folder, from its start or a checkpoint to its end or a request to stop.
class Simulation {
 public:
  /// @param folder      holds the scene's text; whatever a trajectory in it has behind the checkpoint is removed
  /// @param checkpoint  where the run goes on; null: it starts
  /// @param control, listener  must outlive the simulation
  /// @param team  ranks that share its sums, which must outlive it, too; null: none
  Simulation(const SceneConfig& scene, const RunFolder& folder, const Checkpoint* checkpoint, RunControl& control,
             RunListener& listener, const RunHooks& hooks = {}, SumTeam* team = nullptr);

  /// Says what is going to be computed, how, and what it will take.
  void introduce();

  /// To the listener and in run.log.
  void say(const std::string& text) { messages_.say(text); }

  /// To the end of the scene, or until it is asked to stop, with a checkpoint in either case.
  /// @throws Error(numerical) after saving the last good state as a checkpoint and as a frame.
  ExitCode run();

 private:
  void advance_to_end();
  void take_step();
  void count(const StepReport& report);
  void save_last_good_state(const Error& error);
  void report_end(ExitCode code);
  CostCard say_cost();

  SceneConfig scene_;
  RunFolder folder_;
  RunControl& control_;
  SumTeam* team_;
  RunMessages messages_;
  Physics physics_;
  State state_;
  FiberDynamics dynamics_;
  std::unique_ptr<RightHandSide> decorator_;  ///< null: none
  WatchedDynamics watched_dynamics_;
  std::unique_ptr<Integrator> integrator_;
  RunLedger ledger_;
  RunRecorder recorder_;
  CheckpointKeeper checkpoints_;
  double step_seconds_ = 0.0;  ///< of the last one
};

}  // namespace skein
