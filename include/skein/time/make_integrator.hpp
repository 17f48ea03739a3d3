#pragma once

#include <skein/config/scene_config.hpp>
#include <skein/scene/fiber.hpp>
#include <skein/time/integrator.hpp>

#include <memory>

namespace skein {

/// The integrator a scene asks for. Errors are measured against the longest fiber's length.
/// @param rhs  must outlive the integrator
std::unique_ptr<Integrator> make_integrator(const SceneConfig& scene, const std::vector<Fiber>& fibers,
                                            RightHandSide& rhs);

}  // namespace skein
