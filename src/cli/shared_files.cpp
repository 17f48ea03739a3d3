#include "cli/shared_files.hpp"

#include <skein/core/error.hpp>

#include "skein_places.hpp"

#include <fmt/format.h>

#include <system_error>

namespace skein {

std::filesystem::path find_shared_file(const std::string& installed, const std::string& in_sources) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path places[] = {program.parent_path() / share_from_program / installed,
                             fs::path(source_folder) / in_sources};
  for (const fs::path& place : places)
    if (fs::exists(place, error)) return place.lexically_normal();
  throw Error(ExitCode::missing_input,
              fmt::format("what comes with the program is not there: neither {} nor {}",
                          places[0].lexically_normal().string(), places[1].lexically_normal().string()));
}

}  // namespace skein
