#pragma once

#include <skein/scene/scene_file.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// A scene with each copy of a fiber in its list, chains with numbers of their own.
struct PlacedScene {
  SceneConfig config;
  std::vector<Problem> warnings;
  std::string text;  ///< with every key, as a run folder holds it; it is known to be read back as `config`
};

/// Reads a scene's file and puts its fibers where they belong. What goes with the scene's time scale has become a
/// number.
/// @throws what read_scene and write_readable_scene throw; ResourceError if there is not the memory for it; SceneError
/// where fibers find no place or overlap
PlacedScene read_placed_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides);

/// The same for the text of a scene; `name` stands for the file in messages.
PlacedScene read_placed_scene_text(const std::string& text, const std::string& name,
                                   const std::vector<std::string>& overrides);

}  // namespace skein
