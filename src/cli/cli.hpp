#pragma once

#include "cli/verb.hpp"

#include <vector>

namespace skein {

/// Reads the command line, does what it says and turns whatever goes wrong into a message on stderr.
/// @param make_verbs  all verbs but those that tell of all verbs, in the order of the help text
/// @returns the exit code, one of ExitCode or that of a program that was called.
int run_command_line(int n_arguments, char** arguments, const std::vector<Verb (*)()>& make_verbs);

}  // namespace skein
