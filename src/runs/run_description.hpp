#pragma once

#include <skein/fibers/fiber.hpp>
#include <skein/io/trajectory.hpp>
#include <skein/scene/scene_config.hpp>
#include <skein/solvers/integrator.hpp>

#include "runs/evaluation_cost.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace skein {

/// What a run folder says of itself in every trajectory.
TrajectoryLayout describe_layout(const SceneConfig& scene, const std::string& scene_text,
                                 const std::vector<Fiber>& fibers);

/// A run's first lines: version, device, size, methods and why, what it will take.
/// @param spectral_radius   at the start, 1 / time; not finite: not known
/// @param forces            as they describe themselves, beside the springs; empty where there are none
/// @param checkpoint_bytes  of one checkpoint
std::string describe_run(const SceneConfig& scene, const std::vector<Fiber>& fibers, const std::string& forces,
                         const Integrator& integrator, const EvaluationCost& cost, double spectral_radius,
                         std::size_t checkpoint_bytes);

}  // namespace skein
