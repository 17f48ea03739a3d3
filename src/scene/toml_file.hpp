#pragma once

#include <skein/scene/sweep_file.hpp>

#include "scene_reader.hpp"
#include "scene_value.hpp"
#include "toml_parser.hpp"

#include <filesystem>
#include <string>

namespace skein {

/// What messages say of a file.
struct TomlFileKind {
  const char* name;            ///< "scene"
  const char* where_to_begin;  ///< half a sentence for who has an empty one
  ParseLimits limits;
};
inline constexpr TomlFileKind scene_file{"scene", "'skein defaults' prints a scene to start from", limits_of_scenes};
inline constexpr TomlFileKind sweep_file{
    "sweep", "'skein help sweep' shows one to start from", {limits_of_scenes.levels + 2, most_sweep_runs + 1}};

/// The text of a file, as far as a scene may go.
/// @throws Error(missing_input) if it is not there or cannot be read, SceneError if it is larger than largest_scene
std::string read_toml_file(const std::filesystem::path& file, const TomlFileKind& kind);

/// The table that it holds. @throws SceneError naming the first place that is no TOML
SceneValue parse_toml_file(const std::string& text, const SceneSource& source, const TomlFileKind& kind);

}  // namespace skein
