#pragma once

#include <skein/scene/scene_file.hpp>

#include <string>
#include <vector>

namespace skein {

inline SceneConfig read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_scene_text(text, "scene.toml", overrides).config;
}

inline std::size_t count_warnings(const std::string& text) {
  return read_scene_text(text, "scene.toml", {}).warnings.size();
}

/// First lines of what is wrong with a scene.
inline std::vector<std::string> problems_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> lines;
  try {
    read(text, overrides);
  } catch (const SceneError& error) {
    for (const Problem& problem : error.problems()) {
      const std::string description = problem.describe();
      lines.push_back(description.substr(0, description.find('\n')));
    }
  }
  return lines;
}

}  // namespace skein
