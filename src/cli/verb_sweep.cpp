#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>
#include <skein/io/atomic_file.hpp>

#include "cli/common_arguments.hpp"
#include "cli/plot_scripts.hpp"
#include "cli/sweep_listener.hpp"
#include "cli/terminal.hpp"
#include "cli/thread_waiting.hpp"
#include "cli/verbs.hpp"
#include "studies/sweep_scenes.hpp"
#include "studies/sweep_slurm.hpp"
#include "studies/sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace skein {
namespace {

namespace fs = std::filesystem;

struct SweepOptions {
  fs::path sweep, folder;  ///< no sweep: the folder's own
  SideBySide how;
  std::string shard;  ///< empty: all runs
  int n_tasks = 0;    ///< of a job array; 0: one for each run, to a hundred
  std::vector<std::string> pictures;
  std::string format = "png";
  bool slurm = false, gather = false, retry = false, dry_run = false, no_plots = false, quiet = false;
};

/// Tables that can be looked at while the runs go on.
class TableListener final : public SweepListener {
 public:
  /// @param results  of all runs; those that end are put in
  TableListener(const Sweep& sweep, std::vector<std::optional<RunResult>>& results, const bool writes, const bool quiet)
      : SweepListener(sweep.runs.names, quiet), sweep_(sweep), results_(results), writes_(writes) {}

  void end_of_run(const std::size_t run, const RunResult& result, const double seconds) override {
    SweepListener::end_of_run(run, result, seconds);
    results_[run] = result;
    using Clock = std::chrono::steady_clock;
    if (!writes_ || Clock::now() < next_) return;
    write_sweep_tables(sweep_, results_);
    next_ = Clock::now() + std::chrono::minutes(1);
  }

 private:
  const Sweep& sweep_;
  std::vector<std::optional<RunResult>>& results_;
  bool writes_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + std::chrono::minutes(1);
};

int list_sweep(const SweepOptions& options) {
  if (options.sweep.empty())
    throw Error(ExitCode::usage, "--dry-run needs a sweep's file\n'skein sweep --help' shows what can be written");
  const SweepConfig sweep = check_sweep(options.sweep);
  check_sweep_pictures(options.sweep, sweep);
  for (std::size_t run = 0; run < count_sweep_runs(sweep); ++run)
    print_result(fmt::format("{}  {}\n", name_sweep_run(run), describe_sweep_run(sweep, run)));
  return 0;
}

int write_job_array(const SweepOptions& options, const Sweep& sweep) {
  constexpr std::size_t usual_tasks = 100;
  const std::size_t n_runs = sweep.runs.names.size();
  const int n_tasks = static_cast<int>(options.n_tasks > 0 ? std::min<std::size_t>(options.n_tasks, n_runs)
                                                           : std::min(usual_tasks, n_runs));
  const fs::path program = fs::read_symlink("/proc/self/exe");
  write_file_atomically(sweep.folder.slurm_script(), write_slurm_script(sweep, program.string(), n_tasks));
  print_result(sweep.folder.slurm_script().string() + "\n");
  print_note(
      fmt::format("{} runs in {} tasks: 'sbatch --time=8:00:00 {}'; when they are done, 'skein sweep -o {} "
                  "--gather' makes tables and pictures",
                  n_runs, n_tasks, sweep.folder.slurm_script().string(), sweep.folder.path.string()));
  return 0;
}

std::vector<std::size_t> list_open(const std::vector<std::optional<RunResult>>& results, const Shard& shard,
                                   const bool retry) {
  std::vector<std::size_t> open;
  for (std::size_t run = 0; run < results.size(); ++run) {
    const bool is_known = results[run] && !(retry && results[run]->code != ExitCode::done);
    if (shard.has(run) && !is_known) open.push_back(run);
  }
  return open;
}

int draw_sweep(const SweepOptions& options, const Sweep& sweep, std::vector<SweepPicture> pictures) {
  if (pictures.empty())
    pictures = sweep.config.pictures.empty() ? choose_sweep_pictures(sweep.config) : sweep.config.pictures;
  if (pictures.empty()) return 0;
  std::vector<std::string> arguments{fs::absolute(sweep.folder.path).string(), "--to-stderr",
                                     "--format=" + options.format};
  for (const SweepPicture& picture : pictures) arguments.push_back("--picture=" + describe_sweep_picture(picture));
  for (const SweepParameter& parameter : sweep.config.parameters)
    if (parameter.is_drawn) arguments.push_back("--drawn=" + parameter.key);
  return run_plot_script("plot_sweep.py", arguments);
}

/// @returns the exit code: 75 where runs are still open that were to be run, else that of the first that failed
int conclude(const SweepOptions& options, const Sweep& sweep, const std::vector<std::optional<RunResult>>& results,
             const Shard& shard) {
  std::size_t n_open = 0, n_failed = 0, n_runs = 0;
  ExitCode failure = ExitCode::done;
  for (std::size_t run = 0; run < results.size(); ++run) {
    if (!shard.has(run)) continue;
    ++n_runs;
    if (!results[run]) ++n_open;
    if (!results[run] || results[run]->code == ExitCode::done) continue;
    if (++n_failed == 1) failure = results[run]->code;
  }
  std::string text = fmt::format("{} runs: {} done", n_runs, n_runs - n_open - n_failed);
  if (n_failed > 0) text += fmt::format(", {} failed", n_failed);
  if (n_open > 0) text += fmt::format(", {} open", n_open);
  print_result(text + (shard.is_whole() ? fmt::format("; {}\n", sweep.folder.table().string()) : "\n"));
  if (n_open > 0 && !options.gather) return static_cast<int>(ExitCode::stopped);
  return static_cast<int>(failure);
}

int run_sweep(SweepOptions& options) {
  if (options.dry_run) return list_sweep(options);
  const Shard shard = options.shard.empty() ? Shard{} : read_shard(options.shard);
  std::vector<SweepPicture> pictures;
  for (const std::string& words : options.pictures) pictures.push_back(read_sweep_picture(words));
  if (!options.sweep.empty()) check_sweep_pictures(options.sweep, read_sweep(options.sweep));
  leave_threads_unbound();
  const Sweep sweep = open_sweep(options.sweep, options.folder);
  for (const SweepPicture& picture : pictures) check_sweep_picture(sweep.config, picture);
  if (options.slurm) return write_job_array(options, sweep);

  const auto lock = lock_sweep(sweep.folder, shard);
  auto results = read_results(sweep.runs);
  if (!options.gather) {
    fs::remove(sweep.folder.stop_request());
    options.how.stop_file = sweep.folder.stop_request();
    const auto open = list_open(results, shard, options.retry);
    for (const std::size_t run : open) results[run].reset();
    TableListener listener(sweep, results, shard.is_whole(), options.quiet);
    run_side_by_side(sweep.runs, open, options.how, listener);
  }
  if (shard.is_whole()) write_sweep_tables(sweep, results);
  const int code = conclude(options, sweep, results, shard);
  const bool draws = shard.is_whole() && !options.no_plots && code != static_cast<int>(ExitCode::stopped);
  const int drawn = draws ? draw_sweep(options, sweep, pictures) : 0;
  return code != 0 ? code : drawn;
}

}  // namespace

Verb make_sweep_verb() {
  const auto options = std::make_shared<SweepOptions>();
  return {
      "sweep",
      "Run many scenes that differ in some keys, and gather what they did",
      {make_argument("sweep", &options->sweep, "FILE", "Sweep file (TOML); may be left out where DIR holds a sweep"),
       make_argument("-o,--output", &options->folder, "DIR", "Folder of the sweep: runs, tables, pictures").require(),
       make_jobs_option(&options->how.n_jobs),
       make_argument("--threads", &options->how.n_threads, "N",
                     "Threads of all runs together (default: OMP_NUM_THREADS or all cores)")
           .within(1, most_host_threads),
       make_argument("--shard", &options->shard, "I/N", "Only every N-th run, from the I-th on; makes no tables"),
       make_flag("--slurm", &options->slurm, "Run nothing: write DIR/sweep.sbatch, a job array that does"),
       make_argument("--tasks", &options->n_tasks, "N", "Tasks of that job array (default: one a run, to 100)")
           .within(1, 100000),
       make_flag("--gather", &options->gather, "Run nothing: make tables and pictures of what there is"),
       make_flag("--retry", &options->retry, "Try runs again that failed"),
       make_flag("--dry-run", &options->dry_run, "Check all scenes and list the runs, write nothing"),
       make_argument("--picture", &options->pictures, "WORDS",
                     "'VALUE over X', 'VALUE over X by Z' or 'VALUE over X and Y' of the table's columns; may be "
                     "repeated"),
       make_argument("--format", &options->format, "png|pdf|svg", "Of the pictures; png without")
           .among({"png", "pdf", "svg"}),
       make_flag("--no-plots", &options->no_plots, "Draw nothing"), make_walltime_option(&options->how.max_walltime),
       make_quiet_flag(&options->quiet)},
      "Examples:\n"
      "  skein sweep configs/sweeps/stiffness.toml -o stiffness\n"
      "  skein sweep -o stiffness                                 goes on after a stop or a kill\n"
      "  skein sweep -o stiffness --gather --picture 'half_period over length by fiber.spring_stiffness'\n"
      "  skein sweep configs/sweeps/stiffness.toml -o stiffness --shard 2/4\n"
      "  skein sweep configs/sweeps/stiffness.toml -o stiffness --slurm && sbatch stiffness/sweep.sbatch\n"
      "A sweep's file:\n"
      "  scene = \"tumbling.toml\"            # beside it: what all runs are changes of\n"
      "  changes = [\"time.end=20.0\"]        # the same for all, as --set has them\n"
      "  [[parameter]]\n"
      "  key = \"fiber.sections\"             # any key of a scene\n"
      "  values = [40, 57, 80]\n"
      "  [[parameter]]\n"
      "  key = \"fiber.spring_stiffness\"\n"
      "  from = 0.005                        # or random, linear, random_logarithmic\n"
      "  to = 0.05\n"
      "  count = 10\n"
      "  spacing = \"logarithmic\"\n"
      "Parameters are crossed, unless combine = \"zipped\", or one goes along with another: with = "
      "\"fiber.sections\".\n"
      "Tables are DIR/table.csv, table.h5 and failures.csv; docs/sweeps.md says what is in them. The exit code is 0\n"
      "if all runs are done, 75 if some are still open, else that of the first run that failed.",
      [options] { return run_sweep(*options); }};
}

}  // namespace skein
