#include "runs/run_to_end.hpp"

#include <skein/io/atomic_file.hpp>
#include <skein/io/checkpoint_folder.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/io/run_lock.hpp>
#include <skein/physics/scene_times.hpp>
#include <skein/scene/scene_file.hpp>

#include "runs/run_control.hpp"
#include "runs/simulate.hpp"

#include <fmt/format.h>

namespace skein {
namespace {

RunFolder open_or_create(const std::filesystem::path& path, const std::string& scene) {
  if (!std::filesystem::exists(path / "scene.toml")) return RunFolder::create(path, scene, /*overwrite=*/false);
  const RunFolder folder = RunFolder::open_begun(path);
  if (read_file(folder.scene()) != scene)
    throw Error(ExitCode::cannot_create,
                fmt::format("'{}' holds a run of another scene; remove it or name another folder.", path.string()));
  return folder;
}

}  // namespace

ExitCode run_to_end(const SceneConfig& scene, const std::filesystem::path& path, const double max_walltime,
                    RunListener& listener) {
  const RunFolder folder = open_or_create(path, write_readable_scene(resolve_times(scene)));
  const RunLock lock(folder);
  const ResumePoint point = find_resume_point(folder);
  if (point.checkpoint && point.checkpoint->number("state.time") >= scene.time.end) return ExitCode::done;
  RunControl control(max_walltime);
  return simulate(scene, folder, point.checkpoint ? &*point.checkpoint : nullptr, control, listener, lock.note());
}

}  // namespace skein
