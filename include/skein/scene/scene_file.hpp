#pragma once

#include <skein/scene/scene_config.hpp>
#include <skein/scene/scene_problem.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace skein {

/// A scene without errors, and what is suspicious in it.
struct SceneReading {
  SceneConfig config;
  std::vector<Problem> warnings;
};

/// What a layer that knows more than the scene's words found wrong with a key, such as "hydrodynamics.order".
struct KeyProblem {
  std::string key;
  std::string message;
};
using SceneCheck = std::function<std::vector<KeyProblem>(const SceneConfig&)>;

/// Reads a TOML scene; missing keys keep their defaults.
///
/// @param overrides  "key=value" in TOML syntax, such as "fiber.sections=113" (all fibers) or "fiber[1].roll=30.0" (the
///                   second); a bare word needs no quotes. Later ones win.
/// @param check      looks at a scene whose keys are sound
/// @throws SceneError with every problem of the file and the overrides, in their order.
/// @throws Error(missing_input) if the file is not there or cannot be read.
SceneReading read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                        const SceneCheck& check = {});

/// The same for the text of a scene; `name` stands for the file in messages.
SceneReading read_scene_text(const std::string& text, const std::string& name,
                             const std::vector<std::string>& overrides, const SceneCheck& check = {});

/// The bytes of a scene's file, which may be a pipe, and so give them once only.
/// @throws SceneError if there are more than scenes have; Error(missing_input) if the file is not there or cannot be
/// read
std::string read_scene_bytes(const std::filesystem::path& file);

/// The scene as TOML with every key, so that it no longer depends on defaults. Reads back to identical values.
std::string write_scene(const SceneConfig& scene);

/// Bytes of the longest text that is read as a scene. Of a thousand fibers with every key it has about one hundredth.
inline constexpr std::size_t largest_scene = std::size_t{64} << 20;

/// write_scene, read again and compared before anybody relies on it: what a run folder holds must serve the resumed
/// run.
/// @throws Error(scene_error) where the text would be longer than what is read, or would be read as another scene
std::string write_readable_scene(const SceneConfig& scene);

}  // namespace skein
