#pragma once

#include <CLI/App.hpp>

namespace skein {

/// --threads N
void add_threads_option(CLI::App& verb, int& threads);

/// --max-walltime T, in seconds
void add_walltime_option(CLI::App& verb, double& seconds);

}  // namespace skein
