#pragma once

#include <skein/physics/mobility.hpp>
#include <skein/scene/scene_config.hpp>

#include <memory>

namespace skein {

/// The mobility a scene asks for.
std::unique_ptr<Mobility> make_mobility(const SceneConfig& scene);

}  // namespace skein
