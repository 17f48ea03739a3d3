#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skein {

/// The names in a folder, sorted. A folder that is not there holds nothing; one that cannot be listed, a link to
/// nowhere and what is no folder are errors, so that "cannot be seen" is never taken for "is not there".
/// @throws Error(io_error) with the system's reason
std::vector<std::string> list_names(const std::filesystem::path& folder);

/// Whether a path names something, if only a link to nowhere. @throws Error(io_error) if that cannot be found out
bool is_there(const std::filesystem::path& path);

}  // namespace skein
