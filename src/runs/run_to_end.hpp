#pragma once

#include <skein/core/error.hpp>
#include <skein/scene/scene_config.hpp>

#include "runs/run_listener.hpp"

#include <filesystem>
#include <string>

namespace skein {

/// Brings the run of a scene in a folder to its end: begins it, goes on with it from its last checkpoint, or finds that
/// nothing is left to do. Needs Kokkos.
/// @param max_walltime  seconds since the program began
/// @param start         bytes of the state of another run that the scene begins with (io/start_file)
/// @returns done, or stopped on request
/// @throws Error(cannot_create) if the folder holds a run of another scene, or anything but a run
ExitCode run_to_end(const SceneConfig& scene, const std::filesystem::path& folder, double max_walltime,
                    RunListener& listener, const std::string& start = {});

}  // namespace skein
