#pragma once

#include <skein/fibers/fiber.hpp>
#include <skein/scene/scene_config.hpp>
#include <skein/solvers/integrator.hpp>

#include <memory>

namespace skein {

/// The integrator a scene asks for. Errors are measured against the longest fiber's length.
/// @param rhs  must outlive the integrator
std::unique_ptr<Integrator> make_integrator(const SceneConfig& scene, const std::vector<Fiber>& fibers,
                                            RightHandSide& rhs);

}  // namespace skein
