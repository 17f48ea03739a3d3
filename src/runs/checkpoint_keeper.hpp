#pragma once

#include <skein/core/stopwatch.hpp>
#include <skein/io/checkpoint_folder.hpp>
#include <skein/scene/scene_config.hpp>
#include <skein/solvers/integrator.hpp>

#include "runs/run_control.hpp"
#include "runs/run_ledger.hpp"
#include "runs/run_messages.hpp"
#include "runs/run_recorder.hpp"

#include <cstddef>
#include <filesystem>

namespace skein {

/// All that a run's next step depends on, and what it has written: what checkpoints hold.
struct RunMemory {
  State& state;
  Integrator& integrator;
  RightHandSide& dynamics;
  RunLedger& ledger;
  RunRecorder& recorder;

  void visit(MemoryVisitor& visitor) const;
};

/// Makes a run's checkpoints when they are due, and brings a run back to one.
class CheckpointKeeper {
 public:
  /// All of them must outlive the keeper.
  CheckpointKeeper(const SceneConfig& scene, const RunFolder& folder, RunMemory memory, RunControl& control,
                   RunMessages& messages);

  void restore(const Checkpoint& checkpoint);

  /// In a run whose wall time is limited: measures how long a checkpoint takes on this disk before there is one, so
  /// that time is kept free for it from the start.
  void rehearse() const;

  /// Puts frames and then a checkpoint on disk, unless there is one of this step already.
  void save();

  /// @param time_before  of the last step
  bool is_due(double time_before) const;

  /// Of the next one.
  std::size_t checkpoint_bytes() const;

  std::filesystem::path newest() const { return folder_.path_of(folder_.last_number()); }

 private:
  Checkpoint make_checkpoint() const;

  const SceneConfig& scene_;
  std::string scene_checksum_;
  CheckpointFolder folder_;
  RunMemory memory_;
  RunControl& control_;
  RunMessages& messages_;
  std::int64_t step_of_last_ = -1;
  WallClock::time_point last_ = WallClock::now();
};

}  // namespace skein
