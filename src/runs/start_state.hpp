#pragma once

#include <skein/io/run_folder.hpp>
#include <skein/physics/physics.hpp>
#include <skein/solvers/integrator.hpp>

namespace skein {

/// Where a run of a scene begins: with its fibers as they are written or, where the scene says so, with another run's
/// state. @throws Error(missing_input), Error(io_error), Error(damaged_data) if that state's file is not there, cannot
/// be read, or is not the one that the scene names
/// @param is_resumed  a checkpoint follows, and the state's file is not needed
State make_start_state(const SceneConfig& scene, const RunFolder& folder, bool is_resumed, const Physics& physics);

}  // namespace skein
