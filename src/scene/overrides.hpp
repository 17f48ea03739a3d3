#pragma once

#include "scene_reader.hpp"
#include "scene_value.hpp"

#include <vector>

namespace skein {

/// Puts the source's overrides ("key=value") into the tree, in their order. What cannot be put in is added to the
/// problems; whether key and value make sense is left to the reader.
void apply_overrides(SceneValue& root, const SceneSource& source, std::vector<Problem>& problems);

}  // namespace skein
