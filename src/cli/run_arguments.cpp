#include "cli/common_options.hpp"
#include "cli/verb_run.hpp"
#include "cli/verbs.hpp"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace skein {
void add_run_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("run", "Simulate a scene into a run folder");
  const auto options = std::make_shared<RunOptions>();
  verb->add_option("scene", options->scene, "Scene file (TOML)")->required()->type_name("SCENE");
  verb->add_option("-o,--output", options->folder, "Run folder to make")->required()->type_name("DIR");
  verb->add_option("--set", options->overrides, "Override a key of the scene; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  verb->add_flag("--overwrite", options->overwrite, "Replace an earlier run in the folder");
  add_threads_option(*verb, options->threads);
  add_walltime_option(*verb, options->max_walltime);
  verb->add_flag("--dry-run", options->dry_run, "Say what the run would take, write nothing");
  CLI::Option* quiet = verb->add_flag("-q,--quiet", options->quiet, "Errors only");
  verb->add_flag("-v,--verbose", options->verbosity, "More messages; twice for most")->excludes(quiet);
  verb->footer(
      "Examples:\n"
      "  skein run configs/tumbling.toml -o tumbling\n"
      "  skein run configs/tumbling.toml -o longer --set fiber.sections=113 --set time.end=16.0\n"
      "  skein run configs/tumbling.toml -o night --max-walltime 8h --threads 2\n"
      "The exit code is 0 if the end was reached, 75 if the run was stopped and 'skein resume' can go on.\n"
      "SIGINT, SIGTERM and SIGUSR1 stop it with a checkpoint, and so does a file STOP in the run folder; a file\n"
      "OUTPUT_NOW there makes a checkpoint and puts all frames so far on disk.");
  verb->callback([options, &action] { action = [options] { return run_scene(*options); }; });
}

}  // namespace skein
