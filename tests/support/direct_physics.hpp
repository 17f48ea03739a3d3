#pragma once

#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/physics.hpp>

#include <memory>

namespace skein::test {

/// The physics of a scene with velocities by direct sums in double precision, whatever the scene says of them.
inline Physics make_direct_physics(const SceneConfig& scene) {
  Physics physics = make_physics(scene);
  physics.mobility = std::make_unique<DirectMobility>(scene.fluid.viscosity, Precision::in_double);
  return physics;
}

}  // namespace skein::test
