#pragma once

#include <skein/core/error.hpp>
#include <skein/io/checkpoint.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/ranks/communicator.hpp>
#include <skein/scene/scene_config.hpp>

#include "runs/run_control.hpp"
#include "runs/run_listener.hpp"

#include <string>

namespace skein {

/// One run of one scene, for callers that know nothing of devices: introduces itself and goes to the end of the scene,
/// or until it is asked to stop. Needs Kokkos. Faults that the environment orders for tests are put in.
/// @param checkpoint   where the run goes on; null: it starts
/// @param first_words  said before anything else, if there are any
/// @param ranks        whose others serve sums (see share_run); null: none
/// @throws Error(numerical) after saving the last good state
ExitCode simulate(const SceneConfig& scene, const RunFolder& folder, const Checkpoint* checkpoint, RunControl& control,
                  RunListener& listener, const std::string& first_words = {}, Communicator* ranks = nullptr);

/// A run's first lines, for a scene that is not going to be run. Needs Kokkos.
std::string describe_dry_run(const SceneConfig& scene);

}  // namespace skein
