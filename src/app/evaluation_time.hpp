#pragma once

#include <skein/config/scene_config.hpp>
#include <skein/time/fiber_dynamics.hpp>

#include <string>

namespace skein {

/// Wall time of one evaluation, seconds: the median of five after a warm-up.
double time_evaluation(FiberDynamics& dynamics, const ConstVectors& position);

/// A run's first lines, for a scene that is not going to be run.
std::string describe_dry_run(const SceneConfig& scene);

}  // namespace skein
