#pragma once

#include "studies/sweep.hpp"

#include <string>

namespace skein {

/// A job array for sbatch: each task runs a shard with the processors that it gets, is asked to stop before its time is
/// over, and then queues itself again.
/// @param program  that the tasks call
/// @param n_tasks  of the array, at least 1
std::string write_slurm_script(const Sweep& sweep, const std::string& program, int n_tasks);

}  // namespace skein
