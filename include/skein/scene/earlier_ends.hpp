#pragma once

#include <string>

namespace skein {

// A run that is prolonged keeps its folder, and its scene.toml is changed at two lines of [time]: `end`, and
// `earlier_ends`, to which the end of before is added. The text with which the run began follows from the new one, so
// that the chain of checksums can begin with it and nothing else can have been changed.

/// The text of a run's scene with a later end.
/// @throws Error(damaged_data) if the text is not as write_scene makes it
std::string prolong_scene_text(const std::string& text, double end);

/// The text before it was prolonged for the first time; the same text if it never was, or is not as write_scene makes
/// it.
std::string find_first_scene_text(const std::string& text);

/// Whether a text is another one, or became it by being prolonged, perhaps several times.
bool is_prolonged_from(const std::string& text, const std::string& before);

}  // namespace skein
