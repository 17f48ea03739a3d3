#pragma once

#include <skein/io/checkpoint_folder.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/scene/scene_config.hpp>

#include <string>
#include <vector>

namespace skein {

/// A run that goes on, as far as it is known before it does.
struct Resumption {
  SceneConfig scene;
  ResumePoint point;
  std::string warnings;     ///< what is wrong with checkpoints, and other programs that made them; empty: nothing
  std::string first_words;  ///< of the run: these, and from where it goes on

  const Checkpoint* checkpoint() const { return point.checkpoint ? &*point.checkpoint : nullptr; }
};

/// Finds out from where a run goes on, and moves its end where a later one is asked for. The folder must be locked.
/// @param overrides   see find_later_end
/// @param from_start  see find_resume_point
/// @throws what these two throw; ResourceError if there is not the memory for it
Resumption prepare_resumption(const RunFolder& folder, const std::vector<std::string>& overrides, bool from_start);

}  // namespace skein
