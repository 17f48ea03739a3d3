#pragma once

#include <skein/core/vec3.hpp>
#include <skein/scene/scene_config.hpp>

#include <vector>

namespace skein {

/// The fluid's velocity at points, whether or not nodes are there. [n_points], length / time
struct VelocityField {
  std::vector<Vec3> total;
  std::vector<Vec3> disturbance;  ///< total without the background flow: what the fibers' forces add
};

/// @param nodes   [n_nodes] of the scene's fibers, length
/// @param points  [n_points], length
VelocityField compute_velocity_field(const SceneConfig& scene, double time, const std::vector<Vec3>& nodes,
                                     const std::vector<Vec3>& points);

}  // namespace skein
