#pragma once

#include <skein/scene/scene_file.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// Reads a scene and puts its fibers where they belong: each copy is then a fiber of the list. What goes with the
/// scene's time scale has become a number.
/// @throws what read_scene throws; SceneError where fibers find no place or overlap
SceneReading read_placed_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides);

}  // namespace skein
