#pragma once

#include <skein/fibers/fiber.hpp>
#include <skein/io/trajectory.hpp>
#include <skein/scene/scene_config.hpp>
#include <skein/solvers/step_costs.hpp>

#include "runs/evaluation_cost.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace skein {

/// What a run folder says of itself in every trajectory.
TrajectoryLayout describe_layout(const SceneConfig& scene, const std::string& scene_text,
                                 const std::vector<Fiber>& fibers);

/// What is found out of a run before its first step.
struct Prospect {
  EvaluationCost cost;
  double spectral_radius = 0.0;  ///< at the start, 1 / time; not finite: not known
  ExpectedStep step;
  std::size_t checkpoint_bytes = 0;  ///< of one checkpoint
};

/// A run's first lines: version, device, size, methods and why, what it will take.
/// @param forces, integrator  as they describe themselves; forces beside the springs, empty where there are none
std::string describe_run(const SceneConfig& scene, const std::vector<Fiber>& fibers, const std::string& forces,
                         const std::string& integrator, const Prospect& prospect);

}  // namespace skein
