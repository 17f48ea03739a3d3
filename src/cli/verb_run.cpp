#include "cli/verb_run.hpp"

#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>
#include <skein/io/run_folder.hpp>
#include <skein/io/run_lock.hpp>
#include <skein/scene/scene_file.hpp>

#include "cli/terminal.hpp"
#include "cli/terminal_listener.hpp"
#include "runs/placed_scene.hpp"
#include "runs/run_control.hpp"
#include "runs/simulate.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <optional>

namespace skein {
namespace {

// An earlier run's folder is locked before anything in it is replaced; a new one as soon as it is there.
RunFolder make_folder(const RunOptions& options, const std::string& scene_text, std::optional<RunLock>& lock) {
  std::error_code ignored;
  if (options.overwrite && std::filesystem::exists(options.folder / "scene.toml", ignored))
    lock.emplace(RunFolder::open_begun(options.folder));
  RunFolder folder = RunFolder::create(options.folder, scene_text, options.overwrite);
  if (!lock) lock.emplace(folder);
  return folder;
}

}  // namespace

int run_scene(const RunOptions& options) {
  const SceneReading reading = read_placed_scene(options.scene, options.overrides);
  if (!options.quiet && !reading.warnings.empty()) print_warning(describe_problems(reading.warnings));

  const Runtime runtime(options.threads);
  if (options.dry_run) {
    fmt::print("{}\n", describe_dry_run(reading.config));
    return 0;
  }
  RunControl control(options.max_walltime);
  std::optional<RunLock> lock;
  const RunFolder folder = make_folder(options, write_scene(reading.config), lock);
  TerminalListener listener(options.quiet);
  return static_cast<int>(simulate(reading.config, folder, nullptr, control, listener));
}

}  // namespace skein
