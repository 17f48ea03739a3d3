#pragma once

#include <skein/fibers/fiber.hpp>
#include <skein/scene/scene_config.hpp>

#include <vector>

namespace skein {

/// The range that a scene asks for, length: 0 stands for the radius of the thinnest fiber.
double find_repulsion_range(const RepulsionConfig& config, const std::vector<Fiber>& fibers);

}  // namespace skein
