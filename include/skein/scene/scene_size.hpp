#pragma once

#include <skein/scene/scene_config.hpp>

#include <cstddef>

namespace skein {

/// Fibers once placement has made its copies: a whole number.
double count_fibers(const SceneConfig& scene);

/// Copies that placement is going to make of the fiber at this place of the list.
double count_copies(const SceneConfig& scene, std::size_t fiber);

/// Nodes of all fibers once placement has made its copies: a whole number.
double count_scene_nodes(const SceneConfig& scene);

}  // namespace skein
