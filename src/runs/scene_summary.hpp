#pragma once

#include <skein/scene/scene_config.hpp>

#include <string>

namespace skein {

/// The numbers that follow from a scene alone: size, stiffness, both elasto-viscous numbers, ratios of lengths. Lines.
std::string describe_scene(const SceneConfig& scene);

}  // namespace skein
