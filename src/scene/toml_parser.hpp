#pragma once

#include "scene_value.hpp"

#include <string>

namespace skein {

/// What the parser stopped at.
struct SyntaxError {
  Place place;
  std::string message;
};

/// The table that a TOML text holds.
/// @throws SyntaxError at the first thing that is no TOML, no text, or nested beyond reason.
SceneValue parse_toml(const std::string& text);

}  // namespace skein
