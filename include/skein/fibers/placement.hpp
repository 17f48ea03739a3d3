#pragma once

#include <skein/fibers/fiber.hpp>
#include <skein/scene/scene_config.hpp>

#include <cstdint>
#include <vector>

namespace skein {

/// The scene with every copy that its placement asks for listed as a fiber of its own, so that it is "as_written". A
/// random place depends on the seed and the fiber's number alone, and on the fibers before it where they are in the
/// way.
/// @throws Error(scene_error) if random fibers do not fit, with how many did
SceneConfig place_fibers(const SceneConfig& scene);

/// @param seed  of random bends
/// @throws Error(scene_error) if the tubes of two fibers overlap at the start, their ends being flat
void check_overlap(const std::vector<Fiber>& fibers, std::uint64_t seed);

}  // namespace skein
