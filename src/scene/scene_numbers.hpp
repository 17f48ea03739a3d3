#pragma once

#include <skein/scene/scene_config.hpp>

namespace skein {

// What follows from a scene's keys and is needed to judge them together.

/// Shorter vectors cannot be normalized: the squares of their components vanish.
inline constexpr double smallest_direction = 1e-100;

}  // namespace skein
