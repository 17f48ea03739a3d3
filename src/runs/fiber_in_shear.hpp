#pragma once

#include <skein/scene/scene_config.hpp>

#include <optional>

namespace skein {

/// One fiber that starts straight along a steady shear with which it is alone, without units: what tables of runs that
/// were made before are looked up by.
struct FiberInShear {
  double aspect_ratio;  ///< length / radius
  double stiffness;     ///< EI at equilibrium / (viscosity rate radius^4)
  double rate;          ///< of the shear, > 0, 1 / time
};

/// What a scene is as such; none where it is something else: bends or noise of more than a thousandth of the length,
/// springs of several stiffnesses, rigid fibers, other forces than springs and repulsion.
/// @param scene  its fibers are placed
std::optional<FiberInShear> find_fiber_in_shear(const SceneConfig& scene);

/// True where nothing but the flow acts on one fiber as written.
bool is_single_fiber(const SceneConfig& scene);

}  // namespace skein
