#pragma once

#include <filesystem>
#include <string>

namespace skein {

/// What stands in a file. Nothing but a file is read: a pipe, which would wait for a writer, or a folder is an error.
/// @throws Error(missing_input) if there is none, Error(io_error) with the system's reason if it cannot be read
std::string read_file(const std::filesystem::path& path);

/// Looks at what a path names without opening it, for libraries that open it themselves. @throws as read_file
void check_is_file(const std::filesystem::path& path);

}  // namespace skein
