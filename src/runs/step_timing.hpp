#pragma once

#include <skein/scene/scene_config.hpp>

#include <string>

namespace skein {

/// Steps of a scene, from near its start: what they take, and which part of them.
struct StepTiming {
  int n_nodes = 0;
  std::string mobility;  ///< as it describes itself
  double seconds = 0.0, evaluations = 0.0, simulated_time = 0.0;
  double fluid_share = 0.0, springs_share = 0.0;  ///< of a step; the rest is time integration

  double seconds_per_evaluation() const { return seconds / evaluations; }
  double seconds_per_time() const { return seconds / simulated_time; }
};

/// Needs Kokkos. @param seconds  of wall time to spend, about
StepTiming time_steps(const SceneConfig& scene, double seconds);

}  // namespace skein
