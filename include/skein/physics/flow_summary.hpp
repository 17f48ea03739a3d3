#pragma once

#include <skein/physics/velocity_gradient.hpp>
#include <skein/scene/scene_config.hpp>

#include <string>
#include <vector>

namespace skein {

/// What a BackgroundFlow says of itself, for texts and estimates that need no device.
struct FlowSummary {
  double typical_rate = 0.0;  ///< 1 / time
  double time_scale = 0.0;    ///< infinite for a fluid at rest
  std::string description;    ///< one line
};

/// @throws Error(scene_error) for a kind that is not known
FlowSummary summarize_flow(const std::vector<FlowConfig>& flows);

/// The velocity gradient at one position as if all flows were at their full rates: what directions the flow has there.
VelocityGradient compute_typical_gradient(const std::vector<FlowConfig>& flows, Vec3 position);

}  // namespace skein
