#include "runs/checkpoint_keeper.hpp"

#include <skein/arrays/runtime.hpp>
#include <skein/core/version.hpp>
#include <skein/io/trajectory_end.hpp>

#include "runs/checkpoint_memory.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace skein {

void RunMemory::visit(MemoryVisitor& visitor) const {
  visit_memory(visitor, state);
  integrator.visit_memory(visitor);
  dynamics.visit_memory(visitor);
  ledger.visit_memory(visitor);
  recorder.visit_memory(visitor);
}

CheckpointKeeper::CheckpointKeeper(const SceneConfig& scene, const RunFolder& folder, RunMemory memory,
                                   RunControl& control, RunMessages& messages)
    : scene_(scene),
      scene_checksum_(find_trajectory_start(folder).checksum),
      folder_(folder),
      memory_(memory),
      control_(control),
      messages_(messages) {}

void CheckpointKeeper::restore(const Checkpoint& checkpoint) {
  MemoryRestorer restorer(checkpoint);
  memory_.visit(restorer);
  step_of_last_ = memory_.state.step;
}

std::size_t CheckpointKeeper::checkpoint_bytes() const {
  MemorySize size;
  memory_.visit(size);
  return size.bytes();
}

Checkpoint CheckpointKeeper::make_checkpoint() const {
  memory_.ledger.keep_seconds();
  Checkpoint checkpoint;
  MemorySaver saver(checkpoint);
  memory_.visit(saver);
  write_trajectory_end(checkpoint, memory_.recorder.trajectory().end());
  checkpoint.set("scene.xxh3", scene_checksum_);
  checkpoint.set("scene.seed", std::vector<std::int64_t>{static_cast<std::int64_t>(scene_.seed)});
  checkpoint.set("program.version", std::string(version()));
  checkpoint.set("program.commit", std::string(commit()));
  checkpoint.set("program.backend", describe_backend());
  return checkpoint;
}

void CheckpointKeeper::rehearse() const {
  if (!control_.has_walltime()) return;
  // A segment, the index and the XDMF come with a checkpoint, each with its own wait for the disk.
  constexpr double n_files = 4.0;
  const auto start = WallClock::now();
  folder_.rehearse(make_checkpoint());
  control_.note_checkpoint(n_files * seconds_since(start));
}

void CheckpointKeeper::save() {
  const State& state = memory_.state;
  if (step_of_last_ == state.step) return;
  const auto start = WallClock::now();
  TrajectoryWriter& trajectory = memory_.recorder.trajectory();
  const double trajectory_seconds = trajectory.seconds_spent();
  trajectory.close_segment();
  const Checkpoint checkpoint = make_checkpoint();
  memory_.ledger.parts().megabytes += 1e-6 * static_cast<double>(folder_.write(checkpoint, scene_.checkpoint.keep));
  step_of_last_ = state.step;
  last_ = WallClock::now();
  const double seconds = seconds_since(start);
  control_.note_checkpoint(seconds);
  memory_.ledger.parts().checkpoints += seconds - (trajectory.seconds_spent() - trajectory_seconds);
  messages_.events().write(
      "checkpoint",
      {{"number", folder_.last_number()}, {"time", state.time}, {"step", state.step}, {"seconds", seconds}});
}

bool CheckpointKeeper::is_due(const double time_before) const {
  const CheckpointConfig& config = scene_.checkpoint;
  if (config.wall_interval > 0.0 && seconds_since(last_) >= config.wall_interval) return true;
  const double interval = config.simulated_interval;
  return interval > 0.0 && std::floor(memory_.state.time / interval) > std::floor(time_before / interval);
}

}  // namespace skein
