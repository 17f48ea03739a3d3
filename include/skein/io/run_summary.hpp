#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// What a run folder holds, in a few numbers.
struct RunSummary {
  std::string title;
  std::string status;  ///< "running" until the run ends; a killed one says so for ever
  std::int64_t frames = 0;
  std::int64_t steps = 0;  ///< recorded, accepted ones
  std::int64_t segments = 0;
  std::string certificate;                   ///< end of the chain of checksums so far
  std::vector<std::int64_t> segment_frames;  ///< [segments], frames of each
  std::string chain;                         ///< checksums of all segments, 16 digits each; empty in older runs
  double last_time = 0.0;                    ///< of the last frame; NaN where there is none
};

/// @throws Error(missing_input) if there is no run folder, Error(damaged_data) naming the file that is damaged, gone
/// or,
///         as a scene that was edited, no longer of this run, Error(io_error) naming the one that cannot be read
RunSummary read_run_summary(const std::filesystem::path& folder);

}  // namespace skein
