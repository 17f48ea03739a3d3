#pragma once

#include <skein/scene/scene_config.hpp>

namespace skein {

// What follows from a scene's keys and is needed to judge them together.

/// Shorter vectors cannot be normalized: the squares of their components vanish.
inline constexpr double smallest_direction = 1e-100;

/// The chord between neighbouring nodes of a section, which is also the distance of sections. Length
double compute_node_spacing(const FiberConfig& fiber);

}  // namespace skein
