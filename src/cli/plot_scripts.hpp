#pragma once

#include <string>
#include <vector>

namespace skein {

/// Runs one of the plot scripts with the Python that the program was built for, isolated from the environment's Python
/// settings, and this process's streams.
/// @param name  "plot_run.py": of the installed program's scripts, else of the sources it was built from
/// @returns its exit code; failures of Python itself are ExitCode::internal
/// @throws Error(missing_input) if the script is in neither place
int run_plot_script(const std::string& name, std::vector<std::string> arguments);

}  // namespace skein
