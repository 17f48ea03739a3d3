#include "app/verb_run.hpp"

#include <fmt/format.h>

#include <skein/config/scene_file.hpp>
#include <skein/core/error.hpp>
#include <skein/core/runtime.hpp>
#include <skein/io/run_folder.hpp>

#include <cmath>
#include <cstdio>

#include "app/simulation.hpp"
#include "app/terminal.hpp"

namespace skein {

int run_scene(const RunOptions& options) {
  const SceneReading reading = read_scene(options.scene, options.overrides);
  if (!options.quiet && !reading.warnings.empty()) print_warning(describe_problems(reading.warnings));
  const std::string scene_text = write_scene(reading.config);

  const Runtime runtime(options.threads);
  if (options.dry_run) {
    fmt::print("{}\n", describe_dry_run(reading.config));
    return 0;
  }
  const RunFolder folder = RunFolder::create(options.folder, scene_text, options.overwrite);
  Simulation simulation(reading.config, scene_text, folder, ProgressReport::choose_kind(options.quiet), options.quiet);
  simulation.introduce();
  return static_cast<int>(simulation.run(std::isfinite(options.max_walltime) ? options.max_walltime : 0.0));
}

}  // namespace skein
