#pragma once

#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/scene/scene_config.hpp>

#include "runs/evaluation_cost.hpp"

#include <functional>

namespace skein {

/// The spectral radius at these positions, 1 / time, as exactly as what is said of a run needs it: Euler's stability is
/// judged by it, else it only tells what a run takes. Not finite where velocities are not.
double find_spectral_radius(const SceneConfig& scene, FiberDynamics& dynamics, double time,
                            const ConstVectors& position);

EvaluationCost time_evaluation(FiberDynamics& dynamics, const ConstVectors& position);

/// The median wall time of five calls after a first one, seconds; one call of more than a second is enough.
double time_calls(const std::function<void()>& call);

/// Wall time of a direct sum over all nodes, seconds, estimated from one over some of them.
double time_direct_sum(const ConstVectors& position, double viscosity);

}  // namespace skein
