#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>

#include "cli/common_arguments.hpp"
#include "cli/plot_scripts.hpp"
#include "cli/terminal.hpp"
#include "cli/terminal_listener.hpp"
#include "cli/verbs.hpp"
#include "studies/phases.hpp"
#include "studies/rung_name.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace skein {
namespace {

struct PhasesOptions {
  PhaseStudy study;
  std::string rung;  ///< empty: the study's own
  int threads = 0;
  bool quiet = false, no_plots = false;
};

void print_row(const PhaseResult& result) {
  print_result(fmt::format("{:<10.4g} {:<10.4g} {:<10} {}\n", result.length, result.elasto_viscous_number,
                           result.is_perturbed ? "perturbed" : "straight", name_of(result.summary.regime)));
  std::fflush(stdout);
}

int draw_phases(PhasesOptions& options) {
  if (!options.rung.empty()) options.study.rung = read_rung(options.rung);
  const auto points = list_phase_points(options.study);
  const Runtime runtime(options.threads);
  print_result(fmt::format("{:<10} {:<10} {:<10} {}\n", "length", "mu_bar", "start", "regime"));
  TerminalListener listener(options.quiet);
  if (run_phase_study(options.study, points, listener, print_row) == ExitCode::stopped)
    return static_cast<int>(ExitCode::stopped);
  if (options.no_plots) return 0;
  return run_plot_script("plot_phases.py", {std::filesystem::absolute(options.study.folder).string(), "--to-stderr"});
}

}  // namespace

Verb make_phases_verb() {
  const auto options = std::make_shared<PhasesOptions>();
  PhaseStudy& study = options->study;
  return {"phases",
          "Draw the regimes of fibers in shear over their length",
          {make_argument("-o,--output", &study.folder, "FOLDER", "Folder for runs, table and picture"),
           make_argument("--from", &study.from, "", "Shortest length").within(0.01, 10.0),
           make_argument("--to", &study.to, "", "Longest length").within(0.01, 10.0),
           make_argument("--count", &study.count, "", "Number of lengths").within(1, 1000),
           make_argument("--end", &study.end, "", "Time to which each fiber is followed").within(0.1, 1e4),
           make_rung_option(&options->rung, "Cheaper fibers that answer alike"),
           make_argument("--perturbation", &study.perturbation, "KEY=VALUE",
                         "Also each fiber with this key of its scene changed; may be repeated"),
           make_threads_option(&options->threads), make_walltime_option(&study.max_walltime),
           make_flag("--no-plots", &options->no_plots, "Draw nothing"), make_quiet_flag(&options->quiet)},
          "Examples:\n"
          "  skein phases --rung 6 -q\n"
          "  skein phases -o rolled --from 0.15 --to 0.25 --count 11 --perturbation fiber.roll=5.0\n"
          "The fibers are those of LaGrone, Cortez, Yan, Fauci 2019, straight along the flow at first, "
          "and once more with a\n"
          "small bend. Runs that are done are not run again, unfinished ones go on.",
          [options] { return draw_phases(*options); }};
}

}  // namespace skein
