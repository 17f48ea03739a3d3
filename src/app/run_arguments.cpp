#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/duration.hpp"
#include "app/verb_run.hpp"
#include "app/verbs.hpp"

namespace skein {
namespace {

constexpr int n_threads_allowed = 4096;

std::string check_duration(const std::string& text) {
  if (parse_duration(text)) return "";
  return "'" + text + "' is no duration; write seconds, or 90s, 30m, 2h, 1d, 1:30:00";
}

}  // namespace

void add_run_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("run", "Simulate a scene into a run folder");
  const auto options = std::make_shared<RunOptions>();
  verb->add_option("scene", options->scene, "Scene file (TOML)")->required()->type_name("SCENE");
  verb->add_option("-o,--output", options->folder, "Run folder to make")->required()->type_name("DIR");
  verb->add_option("--set", options->overrides, "Override a key of the scene; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  verb->add_flag("--overwrite", options->overwrite, "Replace an earlier run in the folder");
  verb->add_option("--threads", options->threads, "Threads of the host (default: OMP_NUM_THREADS or all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, n_threads_allowed));
  verb->add_option_function<std::string>(
          "--max-walltime", [options](const std::string& text) { options->max_walltime = *parse_duration(text); },
          "Stop in time, with a checkpoint: seconds, 30m, 2h or 1:30:00")
      ->type_name("T")
      ->check(check_duration);
  verb->add_flag("--dry-run", options->dry_run, "Say what the run would take, write nothing");
  CLI::Option* quiet = verb->add_flag("-q,--quiet", options->quiet, "Errors only");
  verb->add_flag("-v,--verbose", options->verbosity, "More messages; twice for most")->excludes(quiet);
  verb->footer(
      "Examples:\n"
      "  skein run configs/tumbling.toml -o tumbling\n"
      "  skein run configs/tumbling.toml -o longer --set fiber.sections=113 --set time.end=16.0\n"
      "  skein run configs/tumbling.toml -o night --max-walltime 8h --threads 2\n"
      "The exit code is 0 if the end was reached, 75 if the run was stopped and can go on.");
  verb->callback([options, &action] { action = [options] { return run_scene(*options); }; });
}

}  // namespace skein
