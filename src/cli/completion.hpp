#pragma once

#include <skein/scene/scene_reference.hpp>

#include "cli/verb.hpp"

#include <string>
#include <vector>

namespace skein {

/// A script for bash that completes verbs, options, their words, scene keys and their words, files and folders.
/// @param keys  that KEY=VALUE may name
std::string write_bash_completion(const std::vector<Verb>& verbs, const std::vector<KeyName>& keys);

}  // namespace skein
