#include <skein/core/error.hpp>
#include <skein/io/folder_listing.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace skein {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_to_list(const fs::path& folder, const std::string& reason) {
  throw Error(ExitCode::io_error, fmt::format("cannot list the folder '{}': {}.", folder.string(), reason));
}

}  // namespace

std::vector<std::string> list_names(const fs::path& folder) {
  if (!is_there(folder)) return {};
  std::error_code error;
  std::vector<std::string> names;
  fs::directory_iterator entry(folder, error);
  if (error == std::errc::no_such_file_or_directory) fail_to_list(folder, "it is a link to what is not there");
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    names.push_back(entry->path().filename().string());
  if (error) fail_to_list(folder, error.message());
  std::sort(names.begin(), names.end());
  return names;
}

bool is_there(const fs::path& path) {
  std::error_code error;
  const fs::file_type type = fs::symlink_status(path, error).type();
  if (type == fs::file_type::none)
    throw Error(ExitCode::io_error, fmt::format("cannot look at '{}': {}.", path.string(), error.message()));
  return type != fs::file_type::not_found;
}

}  // namespace skein
