#pragma once

#include <skein/io/checkpoint_folder.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/scene/scene_config.hpp>

#include <string>

namespace skein {

/// Whether nothing is left to be computed.
bool is_at_end(const SceneConfig& scene, const ResumePoint& point);

/// Brings a run folder in order whose checkpoint is at the end of its scene: a program that was killed after that
/// checkpoint, or damage, leave an index that is old, unreadable or missing, or files that are half-written. Nothing is
/// written where all is in order.
/// @returns what was mended, for people; empty if nothing was to be
/// @throws Error(damaged_data), Error(io_error) if the frames themselves are not whole, or nothing can be written
std::string mend_finished_run(const SceneConfig& scene, const RunFolder& folder, const Checkpoint& checkpoint);

}  // namespace skein
