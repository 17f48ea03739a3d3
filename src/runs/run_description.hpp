#pragma once

#include <skein/io/trajectory.hpp>
#include <skein/physics/physics.hpp>
#include <skein/scene/scene_config.hpp>

#include "runs/evaluation_cost.hpp"

#include <string>

namespace skein {

/// What a run folder says of itself in every trajectory.
TrajectoryLayout describe_layout(const SceneConfig& scene, const std::string& scene_text, const Physics& physics);

/// A run's first lines: version, device, size, methods and why, what it will take.
/// @param integrator  as it describes itself
std::string describe_run(const SceneConfig& scene, const Physics& physics, const std::string& integrator,
                         const EvaluationCost& cost);

}  // namespace skein
