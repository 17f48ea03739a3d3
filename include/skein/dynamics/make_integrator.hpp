#pragma once

#include <skein/physics/physics.hpp>
#include <skein/scene/scene_config.hpp>
#include <skein/solvers/integrator.hpp>

#include <memory>

namespace skein {

/// The integrator a scene asks for. Errors are measured against the longest fiber's length.
/// @param rhs  of this physics, perhaps decorated; must outlive the integrator
std::unique_ptr<Integrator> make_integrator(const SceneConfig& scene, const Physics& physics, RightHandSide& rhs);

}  // namespace skein
