#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>
#include <skein/scene/scene_file.hpp>

#include "cli/common_arguments.hpp"
#include "cli/terminal.hpp"
#include "cli/terminal_listener.hpp"
#include "cli/verbs.hpp"
#include "mpi/launch.hpp"
#include "runs/child_run.hpp"
#include "runs/run_control.hpp"
#include "runs/run_start.hpp"
#include "runs/shared_run.hpp"
#include "runs/simulate.hpp"
#include "runs/useful_threads.hpp"
#include "studies/plan.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace skein {
namespace {

struct RunOptions {
  std::string scene;  ///< empty with `from`: that run's own
  std::string from;   ///< earlier run, and @time; empty: none
  std::filesystem::path folder;
  std::vector<std::string> overrides;                             ///< "key=value"
  std::optional<double> plan;                                     ///< tolerance; none: the scene as it is
  bool overwrite = false;                                         ///< replace an earlier run in the folder
  int threads = 0;                                                ///< of the host; 0 leaves it to the environment
  double max_walltime = std::numeric_limits<double>::infinity();  ///< seconds
  bool dry_run = false;                                           ///< say what it would take, and stop
  bool quiet = false;                                             ///< errors only
};

NewRun make_run(const RunOptions& options) {
  if (options.from.empty() && options.scene.empty())
    throw Error(ExitCode::usage, "a scene is required, or --from RUN\n'skein run --help' shows what can be written");
  if (options.from.empty()) return make_new_run(options.scene, options.overrides);
  return make_child_run(options.from, options.scene, options.overrides);
}

/// The scene as the cheapest adequate model has it.
void plan_scene(PlacedScene& placed, const double tolerance, const bool quiet) {
  PlanRequest request;
  request.tolerance = tolerance;
  Plan plan = make_plan(placed.config, request, [&](const std::string& words) {
    if (!quiet) print_note(words);
  });
  if (!quiet) print_note(describe_plan(plan, request));
  if (plan.chosen < 0)
    throw Error(ExitCode::scene_error, plan.reason + "; run the scene without --plan, or ask for less.");
  placed.config = plan.candidates[plan.chosen].scene;
  placed.text = write_readable_scene(placed.config);
}

int run_scene(const RunOptions& options, Communicator* ranks) {
  NewRun run = make_run(options);
  PlacedScene& placed = run.placed;
  if (!run.what_happened.empty()) print_warning(run.what_happened);
  if (!options.quiet && !placed.warnings.empty()) print_warning(describe_problems(placed.warnings));

  const Runtime runtime(options.threads, count_useful_threads(placed.config));
  if (options.plan) plan_scene(placed, *options.plan, options.quiet);
  if (options.dry_run) {
    print_result(describe_dry_run(placed.config) + "\n");
    return 0;
  }
  RunControl control(options.max_walltime);
  std::optional<RunLock> lock;
  const RunFolder folder = create_run_folder(run, options.scene, options.folder, options.overwrite, lock);
  if (!lock->note().empty()) print_warning(lock->note());
  TerminalListener listener(options.quiet);
  return static_cast<int>(simulate(placed.config, folder, nullptr, control, listener, run.what_happened, ranks));
}

}  // namespace

Verb make_run_verb() {
  const auto options = std::make_shared<RunOptions>();
  return {
      "run",
      "Simulate a scene into a run folder",
      {make_argument("scene", &options->scene, "SCENE", "Scene file (TOML); may be left out with --from"),
       make_argument("--from", &options->from, "RUN[@TIME]",
                     "Begin with the state that an earlier run has reached, or with its frame at this time"),
       make_argument("-o,--output", &options->folder, "DIR", "Run folder to make").require(),
       make_overrides_option(&options->overrides),
       make_argument("--plan", &options->plan, "TOLERANCE",
                     "Run the cheapest model whose answers stay within this, as 'skein plan' finds it")
           .within(1e-4, 0.5)
           .exclude("--from"),
       make_flag("--overwrite", &options->overwrite, "Replace an earlier run in the folder"),
       make_threads_option(&options->threads), make_walltime_option(&options->max_walltime),
       make_flag("--dry-run", &options->dry_run, "Say what the run would take, write nothing"),
       make_quiet_flag(&options->quiet)},
      "Examples:\n"
      "  skein run configs/tumbling.toml -o tumbling\n"
      "  skein run configs/tumbling.toml -o longer --set fiber.sections=113 --set time.end=16.0\n"
      "  skein run configs/tumbling.toml -o night --max-walltime 8h --threads 2\n"
      "  skein run configs/lagrone2019_L0523.toml -o quick --plan 0.03\n"
      "  skein run --from tumbling -o softer --set time.end=24.0 --set fiber.spring_stiffness=0.005\n"
      "  skein run --from tumbling@5.45 other.toml -o other\n"
      "  mpirun -n 4 skein run configs/lagrone2019_L228.toml -o shared\n"
      "With --from time goes on at the time of the earlier run, whose scene it is, with these changes, unless another "
      "one\n"
      "is named.\n"
      "The exit code is 0 if the end was reached, 75 if the run was stopped and 'skein resume' can go on.\n"
      "Interrupts and what batch systems send (SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1, SIGUSR2, SIGALRM) stop it\n"
      "with a checkpoint, and so does a file STOP in the run folder; a file OUTPUT_NOW there makes a checkpoint and\n"
      "puts all frames so far on disk.",
      [options] {
        options->threads = share_threads(options->threads);
        return share_run(join_ranks(), options->threads,
                         [&](Communicator* ranks) { return run_scene(*options, ranks); });
      },
      /*takes_ranks=*/true};
}

}  // namespace skein
