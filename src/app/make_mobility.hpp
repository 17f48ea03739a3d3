#pragma once

#include <skein/config/scene_config.hpp>
#include <skein/hydro/mobility.hpp>

#include <memory>

namespace skein {

/// The mobility a scene asks for.
std::unique_ptr<Mobility> make_mobility(const SceneConfig& scene);

}  // namespace skein
