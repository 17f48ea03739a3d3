#pragma once

#include "cli/verb.hpp"

#include <string>
#include <vector>

namespace skein {

/// scene: a file, which must be there
Argument make_scene_argument(std::string* scene);

/// folder: that of a run, which must be there
Argument make_folder_argument(std::string* folder);

/// --set KEY=VALUE
Argument make_overrides_option(std::vector<std::string>* overrides);

/// --rung RUNG, whose text read_rung reads.
/// @param meaning  of what runs
Argument make_rung_option(std::string* rung, const std::string& meaning);

/// --threads N
Argument make_threads_option(int* threads);

/// --jobs N: of runs side by side
Argument make_jobs_option(int* jobs);

/// --max-walltime T, in seconds
Argument make_walltime_option(double* seconds);

/// -q, --quiet
Argument make_quiet_flag(bool* quiet);

}  // namespace skein
