#pragma once

#include <filesystem>
#include <string>

namespace skein {

/// A file or folder that comes with the program: beside an installed one, else in the sources that it was built from.
/// @param installed   below the share folder of an installation, such as "plots/plot_run.py"
/// @param in_sources  below the sources' folder, such as "tools/plots/plot_run.py"
/// @throws Error(missing_input) if it is in neither place
std::filesystem::path find_shared_file(const std::string& installed, const std::string& in_sources);

}  // namespace skein
