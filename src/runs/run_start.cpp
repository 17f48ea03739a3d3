#include "runs/run_start.hpp"

#include <skein/core/error.hpp>

#include <fmt/format.h>

#include <system_error>

namespace skein {

RunFolder create_run_folder(const NewRun& run, const std::filesystem::path& scene, const std::filesystem::path& folder,
                            const bool overwrite, std::optional<RunLock>& lock) {
  std::error_code ignored;
  if (std::filesystem::equivalent(folder, run.parent, ignored))
    throw Error(ExitCode::cannot_create,
                fmt::format("'{}' is the run to begin with; name another output folder", folder.string()));
  const auto use = [&](const RunFolder& found) {
    if (!scene.empty() && found.is_part(scene))
      throw Error(ExitCode::cannot_create,
                  fmt::format("the scene '{}' belongs to the run that --overwrite would remove; copy it to another "
                              "folder first.",
                              scene.string()));
    lock.emplace(found);
  };
  return RunFolder::create(folder, run.placed.text, overwrite, use, run.start);
}

}  // namespace skein
