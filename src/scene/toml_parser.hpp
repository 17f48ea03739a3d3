#pragma once

#include "scene_value.hpp"

#include <cstddef>
#include <string>

namespace skein {

/// What the parser stopped at.
struct SyntaxError {
  Place place;
  std::string message;
};

/// What is kept of a text. Values below are not looked at, whatever their depth.
struct ParseLimits {
  int levels;               ///< of nested values
  std::size_t list_values;  ///< of a list that holds no tables
};
inline constexpr ParseLimits limits_of_scenes{5, 64};  // deeper and longer than any key of a scene

/// The table that a TOML text holds.
/// @throws SyntaxError at the first thing that is no TOML, no text, or nested beyond reason.
SceneValue parse_toml(const std::string& text, const ParseLimits& limits = limits_of_scenes);

}  // namespace skein
