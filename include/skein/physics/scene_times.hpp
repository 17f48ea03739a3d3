#pragma once

#include <skein/scene/scene_config.hpp>
#include <skein/scene/scene_file.hpp>

#include <vector>

namespace skein {

/// What Physics::time_scale says of a scene whose fibers are as written (see place_fibers), without a device. Time
double find_time_scale(const SceneConfig& scene);

/// The same times with numbers in place of the zeros that stand for what goes with the time scale.
TimeConfig resolve_time(TimeConfig time, double time_scale);

/// hydrodynamics.tolerance, or what is balanced with the error of the time step where that is 0: over a time scale a
/// sum may take a fiber as far astray as 2.5 steps of the error control may, between 1e-6 and 1e-3; 1e-5 with fixed
/// steps, whose error nobody names. In three digits, so that it does not depend on the unit of time.
double find_sum_tolerance(const SceneConfig& scene);

/// What makes no sense beside the scene's time scale: tolerances and numbers of steps and frames.
std::vector<KeyProblem> find_time_problems(const SceneConfig& scene);

/// The same for a scene, with its sum tolerance: it depends on no default any more.
/// @throws Error(scene_error) where a number makes no sense beside the scene's time scale
SceneConfig resolve_times(SceneConfig scene);

}  // namespace skein
