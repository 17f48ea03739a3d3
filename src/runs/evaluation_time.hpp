#pragma once

#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/scene/scene_config.hpp>

#include <functional>
#include <limits>
#include <string>

namespace skein {

/// Wall times of one evaluation, seconds; not a number where it failed.
struct EvaluationCost {
  double seconds = std::numeric_limits<double>::quiet_NaN();  ///< the median of five after a warm-up
  double direct_seconds = 0.0;                                ///< of a direct sum, where the evaluation is none; else 0
};
EvaluationCost time_evaluation(FiberDynamics& dynamics, const ConstVectors& position);

/// The median wall time of five calls after a first one, seconds; one call of more than a second is enough.
double time_calls(const std::function<void()>& call);

/// Wall time of a direct sum over all nodes, seconds, estimated from one over some of them.
double time_direct_sum(const ConstVectors& position, double viscosity);

/// A run's first lines, for a scene that is not going to be run.
std::string describe_dry_run(const SceneConfig& scene);

}  // namespace skein
