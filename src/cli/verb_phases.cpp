#include <skein/core/error.hpp>

#include "cli/common_arguments.hpp"
#include "cli/plot_scripts.hpp"
#include "cli/sweep_listener.hpp"
#include "cli/terminal.hpp"
#include "cli/thread_waiting.hpp"
#include "cli/verbs.hpp"
#include "studies/phases.hpp"
#include "studies/rung_name.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace skein {
namespace {

struct PhasesOptions {
  PhaseStudy study;
  std::string rung;  ///< empty: the study's own
  bool quiet = false, no_plots = false;
};

/// Prints a row for each point, in their order, once it and all before it are measured.
class PhaseListener final : public SideBySideListener {
 public:
  PhaseListener(const std::vector<PhasePoint>& points, const bool quiet)
      : points_(points), results_(points.size()), names_(list_names(points)), progress_(names_, quiet) {}

  void begin(const std::size_t n_open, const int n_jobs, const int n_threads) override {
    progress_.begin(n_open, n_jobs, n_threads);
  }
  void end_of_run(const std::size_t run, const RunResult& result, const double seconds) override {
    progress_.end_of_run(run, result, seconds);
    results_[run] = result;
    for (; n_printed_ < results_.size() && results_[n_printed_]; ++n_printed_)
      if (results_[n_printed_]->code == ExitCode::done)
        print_result(describe_phase(points_[n_printed_], results_[n_printed_]->measures) + "\n");
    std::fflush(stdout);
  }
  void look(const std::size_t n_running) override { progress_.look(n_running); }

 private:
  static std::vector<std::string> list_names(const std::vector<PhasePoint>& points) {
    std::vector<std::string> names;
    for (const PhasePoint& point : points) names.push_back(point.folder);
    return names;
  }

  const std::vector<PhasePoint>& points_;
  std::vector<std::optional<RunResult>> results_;
  std::size_t n_printed_ = 0;
  std::vector<std::string> names_;
  SweepListener progress_;
};

int draw_phases(PhasesOptions& options) {
  if (!options.rung.empty()) options.study.rung = read_rung(options.rung);
  leave_threads_unbound();
  const auto points = list_phase_points(options.study);
  print_result(fmt::format("{:<10} {:<10} {:<10} {}\n", "length", "mu_bar", "start", "regime"));
  PhaseListener listener(points, options.quiet);
  const ExitCode code = run_phase_study(options.study, points, listener);
  if (code != ExitCode::done || options.no_plots) return static_cast<int>(code);
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
           make_jobs_option(&study.how.n_jobs), make_threads_option(&study.how.n_threads),
           make_walltime_option(&study.how.max_walltime), make_flag("--no-plots", &options->no_plots, "Draw nothing"),
           make_quiet_flag(&options->quiet)},
          "Examples:\n"
          "  skein phases --rung 6 -q\n"
          "  skein phases -o rolled --from 0.15 --to 0.25 --count 11 --perturbation fiber.roll=5.0\n"
          "The fibers are those of LaGrone, Cortez, Yan, Fauci 2019, straight along the flow at first, "
          "and once more with a\n"
          "small bend. Runs that are done are not run again, unfinished ones go on.",
          [options] { return draw_phases(*options); }};
}

}  // namespace skein
