#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// What a run folder was found to be.
struct RunCheck {
  std::vector<std::string> problems;  ///< damage: what is wrong, and where
  int unreadable = 0;                 ///< of the problems: what could not be read, and so not be judged
  std::vector<std::string> notes;     ///< what a killed run leaves behind; harmless
  std::string status = "unknown";     ///< of the index, where it can be read
  std::string parent;                 ///< of which run it began with the state, and when; empty: of none
  std::string checksum;               ///< end of the chain: two runs that share it are equal in every bit
  std::int64_t frames = 0, records = 0, segments = 0, checkpoints = 0;
  double last_time = 0.0;  ///< of the last frame
};

/// Reads every byte of a run: checksums of segments and checkpoints, the chain from the scene to the last frame, frames
/// at exactly the scene's times without gap or repetition, times that are sums of the accepted steps,
/// and the state of another run that it began with, if it did.
/// Where the index is missing or damaged, the segments that are there are checked.
/// @throws Error(missing_input) if there is no run folder, Error(io_error) or SceneError if its scene cannot be read
RunCheck check_run(const std::filesystem::path& folder);

}  // namespace skein
