#pragma once

#include <memory>
#include <skein/config/scene_config.hpp>
#include <skein/core/error.hpp>
#include <skein/io/event_log.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/io/run_log.hpp>
#include <skein/io/trajectory_writer.hpp>
#include <skein/time/fiber_dynamics.hpp>
#include <skein/time/integrator.hpp>
#include <string>

#include "app/progress.hpp"

namespace skein {

/// Wires the layers into one run of one scene. Nothing else does.
class Simulation {
 public:
  /// @param scene_text  the resolved scene, for the folder and the trajectory
  Simulation(const SceneConfig& scene, const std::string& scene_text, const RunFolder& folder,
             ProgressReport::Kind progress, bool quiet);

  /// Says, on stderr and in run.log, what is going to be computed, how, and what it will take.
  void introduce();

  /// To the end of the scene. @throws Error(numerical) after saving the last good state as a frame.
  /// @param max_walltime  seconds, 0 for no limit
  ExitCode run(double max_walltime);

 private:
  void write_frames_up_to(double time);
  void write_frame(std::int64_t step, double time, const ConstVectors& position);
  void record_step(const StepReport& report);
  void say(const std::string& text);
  std::string describe_cost() const;

  SceneConfig scene_;
  std::vector<Fiber> fibers_;
  FiberDynamics dynamics_;
  State state_;
  std::unique_ptr<Integrator> integrator_;
  RunLog log_;
  EventLog events_;
  TrajectoryWriter trajectory_;
  ProgressReport progress_;
  Vectors frame_position_;
  std::int64_t next_frame_ = 0;
  std::int64_t rejected_ = 0;
  std::int64_t evaluations_before_ = 0;  ///< spent on measuring their cost
  double seconds_ = 0.0;
  bool quiet_;
};

/// The lines of introduce() for a scene that is not going to be run.
std::string describe_dry_run(const SceneConfig& scene);

}  // namespace skein
