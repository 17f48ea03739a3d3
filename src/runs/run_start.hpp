#pragma once

#include <skein/io/run_folder.hpp>
#include <skein/io/run_lock.hpp>

#include "runs/child_run.hpp"

#include <filesystem>
#include <optional>

namespace skein {

/// Makes the folder of a new run, and locks it before anything in it is written or replaced.
/// @param scene  the file that the run was made of, empty if it has none: it may not lie where the run is to be
/// @throws Error(cannot_create) also where the folder is that of the run to begin with; what RunFolder::create and
/// RunLock throw
RunFolder create_run_folder(const NewRun& run, const std::filesystem::path& scene, const std::filesystem::path& folder,
                            bool overwrite, std::optional<RunLock>& lock);

}  // namespace skein
