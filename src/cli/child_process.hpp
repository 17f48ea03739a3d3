#pragma once

#include <string>
#include <vector>

namespace skein {

/// Runs a program with this process's streams and waits for it.
/// @returns its exit code. @throws Error(internal) if it cannot be started or is killed by a signal.
int run_program(const std::string& program, const std::vector<std::string>& arguments);

}  // namespace skein
