#include "runs/expected_output.hpp"

#include <skein/io/disk_use.hpp>
#include <skein/io/trajectory_writer.hpp>
#include <skein/scene/scene_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

/// Also those that newer ones replace; the first is that of the start, the last that of the end.
double count_checkpoints(const SceneConfig& scene, const double seconds) {
  const CheckpointConfig& config = scene.checkpoint;
  double n = 2.0;
  if (config.wall_interval > 0.0) n += std::floor(seconds / config.wall_interval);
  if (config.simulated_interval > 0.0) n += std::floor((scene.time.end - scene.time.start) / config.simulated_interval);
  return n;
}

}  // namespace

std::string describe_expected_output(const SceneConfig& scene, const std::vector<Fiber>& fibers,
                                     const Expectation& expectation) {
  const SegmentLimits limits;
  const double seconds = std::isfinite(expectation.seconds) ? expectation.seconds : 0.0;
  const double n_checkpoints = count_checkpoints(scene, seconds);
  const std::size_t scene_bytes = write_scene(scene).size();
  TrajectoryCounts counts{.frames = 1.0 + std::ceil((scene.time.end - scene.time.start) / scene.output.frame_interval),
                          .records = expectation.steps};
  const DiskUse content = expect_trajectory_size(fibers, scene.output, scene_bytes, counts);
  // With a checkpoint ends a segment, but for that of the start, before which there is nothing.
  counts.segments = n_checkpoints - 1.0 + (content.frames + content.records) / static_cast<double>(limits.bytes) +
                    seconds / limits.seconds;
  const DiskUse use = expect_trajectory_size(fibers, scene.output, scene_bytes, counts);
  const double checkpoints =
      std::min(n_checkpoints, static_cast<double>(scene.checkpoint.keep)) * expectation.checkpoint_bytes;
  const double all = use.all() + checkpoints + static_cast<double>(scene_bytes);
  return fmt::format("{:.0f} frames; {:.3g} MB in the folder, of which {:.2g} MB for about {:.2g} steps", counts.frames,
                     1e-6 * all, 1e-6 * use.records, counts.records);
}

}  // namespace skein
