#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace skein {

/// What `skein run` was asked to do.
struct RunOptions {
  std::filesystem::path scene;
  std::filesystem::path folder;
  std::vector<std::string> overrides;  ///< "key=value"
  bool overwrite = false;              ///< replace an earlier run in the folder
  int threads = 0;                     ///< of the host; 0 leaves the choice to the environment
  double max_walltime = std::numeric_limits<double>::infinity();  ///< seconds
  bool dry_run = false;                                           ///< say what it would take, and stop
  bool quiet = false;                                             ///< errors only
  int verbosity = 0;                                              ///< how many -v
};

/// Simulates a scene into a run folder. @returns the exit code.
int run_scene(const RunOptions& options);

}  // namespace skein
