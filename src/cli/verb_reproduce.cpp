#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>

#include "cli/common_options.hpp"
#include "cli/plot_scripts.hpp"
#include "cli/terminal_listener.hpp"
#include "cli/verbs.hpp"
#include "runs/run_to_end.hpp"
#include "studies/lagrone2019.hpp"
#include "studies/paper_scenes.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace skein {
namespace {

namespace fs = std::filesystem;

struct ReproduceOptions {
  std::string paper, figure, output = "lagrone2019";
  int threads = 0, nodes_per_section = 18;
  double max_walltime = std::numeric_limits<double>::infinity();
  bool json = false, quiet = false, no_plots = false, no_runs = false;
};

// What is asked for: one figure, or those whose runs take minutes.
std::vector<std::string> choose_figures(const std::string& figure) {
  if (figure.empty()) return {"table1", "figure2", "figure3", "figure7"};
  return {figure};
}

bool is_needed(const PaperFiber& fiber, const std::vector<std::string>& figures) {
  for (const std::string& figure : figures)
    if (std::string(fiber.figures).find(" " + figure + " ") != std::string::npos) return true;
  return false;
}

fs::path folder_of(const PaperFiber& fiber, const ReproduceOptions& options) {
  const std::string suffix = options.nodes_per_section == 18 ? "" : fmt::format("_{}", options.nodes_per_section);
  return fs::path(options.output) / (fiber.name + suffix);
}

ExitCode run_needed(const ReproduceOptions& options, const std::vector<std::string>& figures) {
  for (const PaperFiber& fiber : list_paper_fibers()) {
    if (options.no_runs || !is_needed(fiber, figures)) continue;
    const SceneConfig scene = coarsen(make_paper_scene(fiber.sections, fiber.end), options.nodes_per_section);
    TerminalListener listener(options.quiet);
    if (run_to_end(scene, folder_of(fiber, options), options.max_walltime, listener) == ExitCode::stopped)
      return ExitCode::stopped;
  }
  return ExitCode::done;
}

bool is_among(const std::string& figure, const std::vector<std::string>& figures) {
  return std::find(figures.begin(), figures.end(), figure) != figures.end();
}

// Of all runs that are there, also of those that other figures asked for.
PaperRuns analyze_runs(const ReproduceOptions& options) {
  PaperRuns runs;
  for (const PaperFiber& fiber : list_paper_fibers()) {
    const fs::path path = folder_of(fiber, options);
    if (!fs::exists(path / "trajectory.h5")) continue;
    const RunFolder folder = RunFolder::open(path);
    RunAnalysis analysis = analyze_run(folder, true);
    write_analysis(analysis, folder.analysis());
    runs.emplace(fiber.name, std::move(analysis));
  }
  return runs;
}

int reproduce(const ReproduceOptions& options) {
  const auto figures = choose_figures(options.figure);
  std::vector<AcceptanceRow> rows;
  ExitCode code = ExitCode::done;
  {
    const Runtime runtime(options.threads);
    code = run_needed(options, figures);
    const auto& fibers = list_paper_fibers();
    const bool needs_runs =
        std::any_of(fibers.begin(), fibers.end(), [&](const PaperFiber& fiber) { return is_needed(fiber, figures); });
    const PaperRuns runs = needs_runs ? analyze_runs(options) : PaperRuns{};
    fs::create_directories(options.output);
    std::vector<SumTiming> timings;
    if (is_among("figure8", figures) && !options.no_runs) {
      timings = time_paper_sums();
      write_timings_csv(fs::path(options.output) / "timings.csv", timings);
    }
    for (const std::string& figure : figures)
      for (AcceptanceRow& row : compare_with_paper(figure, runs, timings)) rows.push_back(std::move(row));
  }
  write_rows_csv(fs::path(options.output) / "comparison.csv", rows);
  fmt::print("{}", options.json ? describe_rows_as_json(rows) : describe_rows(rows));
  std::fflush(stdout);
  if (!options.no_plots) {
    std::vector<std::string> arguments{fs::absolute(options.output).string()};
    if (options.nodes_per_section != 18) arguments.push_back(fmt::format("--nodes={}", options.nodes_per_section));
    // The paths of the pictures are messages here: stdout holds the table alone.
    arguments.push_back("--to-stderr");
    if (const int failure = run_plot_script("plot_paper.py", arguments); failure != 0) return failure;
  }
  if (code == ExitCode::stopped) return static_cast<int>(code);
  return static_cast<int>(worst(rows) == Verdict::differs ? ExitCode::numerical : ExitCode::done);
}

std::string list_figures() {
  std::string text;
  for (const auto& [name, what] : list_paper_figures()) text += fmt::format("  {:<8} {}\n", name, what);
  return text;
}

}  // namespace

void add_reproduce_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("reproduce", "Run, measure and draw what a paper shows, and compare");
  const auto options = std::make_shared<ReproduceOptions>();
  std::vector<std::string> figures;
  for (const auto& figure : list_paper_figures()) figures.push_back(figure.first);
  verb->add_option("paper", options->paper, "Which paper")->required()->check(CLI::IsMember({"lagrone2019"}));
  verb->add_option("figure", options->figure, "Which figure; without: table1, figure2, figure3, figure7")
      ->check(CLI::IsMember(figures));
  verb->add_option("-o,--output", options->output, "Folder for runs, pictures and the table")->type_name("FOLDER");
  verb->add_option("--nodes-per-section", options->nodes_per_section,
                   "Cheaper fibers of the same bending rigidity: 9 takes a thirtieth, half periods change by 1 %")
      ->check(CLI::Range(3, 18));
  add_threads_option(*verb, options->threads);
  add_walltime_option(*verb, options->max_walltime);
  verb->add_flag("--json", options->json, "The table as JSON");
  verb->add_flag("--no-runs", options->no_runs, "Compare what is there");
  verb->add_flag("--no-plots", options->no_plots, "Draw nothing");
  verb->add_flag("-q,--quiet", options->quiet, "Errors only");
  verb->footer("Figures of LaGrone, Cortez, Yan, Fauci 2019:\n" + list_figures() +
               "Examples:\n"
               "  skein reproduce lagrone2019\n"
               "  skein reproduce lagrone2019 --nodes-per-section 9 -o quick\n"
               "  skein reproduce lagrone2019 figure5 --max-walltime 2h\n"
               "Runs that are done are not run again, unfinished ones go on. The exit code is 0, 75 if a run was "
               "stopped,\n"
               "76 if a row differs by more than its tolerance.");
  verb->callback([options, &action] { action = [options] { return reproduce(*options); }; });
}

}  // namespace skein
