
#include <skein/core/error.hpp>
#include <skein/io/folder_listing.hpp>
#include <skein/io/run_leftovers.hpp>

#include "run_file_names.hpp"
#include "segment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <system_error>

namespace skein {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::vector<fs::path> find_leftovers(const RunFolder& folder, const std::int64_t n_segments) {
  std::set<std::string> listed;
  for (std::int64_t number = 0; number < n_segments; ++number)
    listed.insert(fs::path(segment_name(number)).filename().string());
  std::vector<fs::path> leftovers;
  for (const std::string& name : list_names(folder.segments()))
    if (is_numbered_file(name) && listed.count(name) == 0) leftovers.push_back(folder.segments() / name);
  for (const std::string& name : list_names(folder.checkpoints()))
    if ((is_numbered_file(name) || is_rehearsal(name)) && is_half_written(name))
      leftovers.push_back(folder.checkpoints() / name);
  for (const std::string& name : list_names(folder.path()))
    if (is_file_of_a_run(name) && is_half_written(name)) leftovers.push_back(folder.path() / name);
  return leftovers;
}

void remove_leftovers(const RunFolder& folder, const std::int64_t n_segments) {
  for (const fs::path& path : find_leftovers(folder, n_segments)) {
    std::error_code error;
    fs::remove(path, error);
    if (error)
      throw Error(ExitCode::io_error, fmt::format("cannot remove '{}', which is left from before: {}. Move it away.",
                                                  path.string(), error.message()));
  }
}

bool holds_segments(const RunFolder& folder) {
  const auto names = list_names(folder.segments());
  return std::any_of(names.begin(), names.end(),
                     [](const std::string& name) { return is_numbered_file(name) && !is_half_written(name); });
}

}  // namespace skein
