#pragma once

#include "cli/verb.hpp"

#include <functional>
#include <vector>

namespace skein {

/// Reads the command line into the targets of the verb that it names.
/// @returns what it asks for: to run that verb, or to print a help text or the version
/// @throws Error(usage) with what is wrong, what may have been meant and where to read on
std::function<int()> parse_command_line(int n_arguments, char** arguments, const std::vector<Verb>& verbs);

}  // namespace skein
