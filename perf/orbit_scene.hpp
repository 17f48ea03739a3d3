#pragma once

#include <skein/physics/physics.hpp>
#include <skein/scene/scene_config.hpp>

#include <vector>

namespace skein::perf {

/// One of the paper's fibers in its shear flow, or a coarser one of the same bending stiffness.
struct OrbitScene {
  double length = 0.139;   ///< length; rounded to whole sections
  int nodes = 6;           ///< on a section; the paper has 18
  int sections = 0;        ///< > 0 takes the length's place
  double stiffness = 1.0;  ///< of the springs, over what has the paper's bending stiffness
  double blob = 1.0;       ///< over the paper's
};

SceneConfig make_orbit_scene(const OrbitScene& orbit);

/// The scene's physics, velocities by direct sums in double precision.
Physics make_direct_physics(const SceneConfig& scene);

/// Between nodes of the same number, length.
double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b);

}  // namespace skein::perf
