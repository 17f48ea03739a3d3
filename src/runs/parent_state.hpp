#pragma once

#include <skein/io/run_folder.hpp>
#include <skein/scene/scene_config.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace skein {

/// The state of a run with which another one begins.
struct ParentState {
  RunFolder folder;
  SceneConfig scene;        ///< of that run
  std::string name;         ///< of its folder, as it was given
  std::string certificate;  ///< end of its chain of checksums
  double time = 0.0;
  std::int64_t step = 0;         ///< accepted ones before the state
  std::vector<double> position;  ///< numbers of all nodes in order, [3 n_nodes], length
  std::string what_happened;     ///< why newer checkpoints do not serve, a line for each; empty: the newest does
};

/// Reads the newest good checkpoint of a run, or one of its frames; the run's folder is left as it is.
/// @param run  "folder", or "folder@time" for the frame at that time
/// @throws Error(missing_input) if there is no such run, checkpoint or frame, with the times of the nearest frames;
///         Error(damaged_data), Error(io_error) naming what is damaged or cannot be read, where no checkpoint is good
ParentState read_parent_state(const std::string& run);

}  // namespace skein
