#include "runs/run_to_end.hpp"

#include <skein/io/checkpoint_folder.hpp>
#include <skein/io/folder_listing.hpp>
#include <skein/io/read_file.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/io/run_lock.hpp>
#include <skein/io/run_scene.hpp>
#include <skein/physics/scene_times.hpp>
#include <skein/scene/scene_file.hpp>

#include "runs/finished_run.hpp"
#include "runs/run_control.hpp"
#include "runs/simulate.hpp"

#include <fmt/format.h>

#include <optional>

namespace skein {
namespace {

RunFolder open_or_create(const std::filesystem::path& path, const std::string& scene, const std::string& start,
                         std::optional<RunLock>& lock) {
  const auto take_lock = [&lock](const RunFolder& folder) { lock.emplace(folder); };
  if (!is_there(path / "scene.toml")) return RunFolder::create(path, scene, /*overwrite=*/false, take_lock, start);
  const RunFolder folder = RunFolder::open_begun(path);
  take_lock(folder);
  if (read_file(folder.scene()) != scene)
    throw Error(ExitCode::cannot_create,
                fmt::format("'{}' holds a run of another scene; remove it or name another folder.", path.string()));
  return folder;
}

}  // namespace

ExitCode run_to_end(const SceneConfig& scene, const std::filesystem::path& path, const double max_walltime,
                    RunListener& listener, const std::string& start) {
  std::optional<RunLock> lock;
  const RunFolder folder = open_or_create(path, write_readable_scene(resolve_times(scene)), start, lock);
  const ResumePoint point = find_resume_point(folder, /*from_start=*/false);
  if (is_at_end(scene, point)) {
    mend_finished_run(read_run_scene(folder), folder, *point.checkpoint);
    return ExitCode::done;
  }
  RunControl control(max_walltime);
  return simulate(scene, folder, point.checkpoint ? &*point.checkpoint : nullptr, control, listener, lock->note());
}

}  // namespace skein
