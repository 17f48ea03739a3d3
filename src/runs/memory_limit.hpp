#pragma once

#include <skein/scene/scene_config.hpp>

namespace skein {

/// Bytes that a run of this scene takes on the host at least; from its keys alone, before anything is made of them.
double estimate_memory(const SceneConfig& scene);

/// Bytes that this process can have at most: the machine's memory, the limits of its control groups (containers, batch
/// jobs) and of its own.
double find_memory_limit();

/// @throws ResourceError, with both numbers, if a scene cannot fit; it would be minutes before that showed
void check_memory(const SceneConfig& scene);

}  // namespace skein
