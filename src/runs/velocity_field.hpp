#pragma once

#include <skein/core/vec3.hpp>
#include <skein/scene/scene_config.hpp>

#include <string>
#include <vector>

namespace skein {

/// How the velocities that the fibers cause are summed.
enum class FieldSum {
  as_the_run,       ///< by the scene's [hydrodynamics]
  direct_in_double  ///< pair by pair, whatever the scene says
};

/// The fluid's velocity at points, whether or not nodes are there. [n_points], length / time
struct VelocityField {
  std::vector<Vec3> total;
  std::vector<Vec3> disturbance;      ///< total without the background flow: what the fibers' forces add
  std::string method;                 ///< how the disturbance was summed, in words
  std::vector<std::string> messages;  ///< what the user should be told of it
};

/// @param nodes   [n_nodes] of the scene's fibers, length
/// @param points  [n_points], length
/// @throws Error(numerical) where a velocity is not finite, naming the point
VelocityField compute_velocity_field(const SceneConfig& scene, double time, const std::vector<Vec3>& nodes,
                                     const std::vector<Vec3>& points, FieldSum sum);

}  // namespace skein
