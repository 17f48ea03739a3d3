#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>

#include "cli/common_arguments.hpp"
#include "cli/plot_scripts.hpp"
#include "cli/terminal.hpp"
#include "cli/terminal_listener.hpp"
#include "cli/verbs.hpp"
#include "studies/reproduction.hpp"
#include "studies/rung_name.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace skein {
namespace {

struct ReproduceOptions {
  std::string paper, figure, rung;
  Reproduction request;
  int threads = 0;
  bool json = false, quiet = false, no_plots = false;
};

ReproductionResult reproduce_asked(const ReproduceOptions& options) {
  Reproduction request = options.request;
  if (!options.rung.empty()) request.rung = read_rung(options.rung);
  for (const PaperFigure& figure : list_paper_figures())
    if (options.figure == figure.name) request.figures = {figure.figure};
  const Runtime runtime(options.threads);
  TerminalListener listener(options.quiet);
  return reproduce_figures(request, listener);
}

int draw(const ReproduceOptions& options) {
  std::vector<std::string> arguments{std::filesystem::absolute(options.request.folder).string()};
  if (!options.rung.empty()) arguments.push_back("--rung=" + options.rung);
  // The paths of the pictures are messages here: stdout holds the table alone.
  arguments.push_back("--to-stderr");
  return run_plot_script("plot_paper.py", arguments);
}

int reproduce(const ReproduceOptions& options) {
  const ReproductionResult result = reproduce_asked(options);
  print_result(options.json ? describe_rows_as_json(result.rows) : describe_rows(result.rows));
  std::fflush(stdout);
  if (!options.no_plots)
    if (const int failure = draw(options); failure != 0) return failure;
  if (result.code == ExitCode::stopped) return static_cast<int>(result.code);
  return static_cast<int>(worst(result.rows) == Verdict::differs ? ExitCode::numerical : ExitCode::done);
}

std::vector<std::string> list_names() {
  std::vector<std::string> names;
  for (const PaperFigure& figure : list_paper_figures()) names.emplace_back(figure.name);
  return names;
}

std::string list_quick_names() {
  std::string text;
  for (const Figure figure : list_quick_figures())
    text += fmt::format("{}{}", text.empty() ? "" : ", ", find_paper_figure(figure).name);
  return text;
}

std::string describe_figures() {
  std::string text;
  for (const PaperFigure& figure : list_paper_figures())
    text += fmt::format("  {:<8} {}\n", figure.name, figure.content);
  return text;
}

}  // namespace

Verb make_reproduce_verb() {
  const auto options = std::make_shared<ReproduceOptions>();
  Reproduction& request = options->request;
  return {"reproduce",
          "Run, measure and draw what a paper shows, and compare",
          {make_argument("paper", &options->paper, "", "Which paper").require().among({"lagrone2019"}),
           make_argument("figure", &options->figure, "", "Which figure; without: " + list_quick_names())
               .among(list_names()),
           make_argument("-o,--output", &request.folder, "FOLDER", "Folder for runs, pictures and the table"),
           make_rung_option(&options->rung, "Of all runs, the paper has 18; without: 18, 9 for L = 0.931, 6 for 2.28"),
           make_threads_option(&options->threads), make_walltime_option(&request.max_walltime),
           make_flag("--json", &options->json, "The table as JSON"),
           make_flag("--no-runs", &request.only_compare, "Compare what is there"),
           make_flag("--no-plots", &options->no_plots, "Draw nothing"), make_quiet_flag(&options->quiet)},
          "Figures of LaGrone, Cortez, Yan, Fauci 2019:\n" + describe_figures() +
              "Examples:\n"
              "  skein reproduce lagrone2019\n"
              "  skein reproduce lagrone2019 --rung 6 -o quick\n"
              "  skein reproduce lagrone2019 figure5 --max-walltime 2h\n"
              "Runs that are done are not run again, unfinished ones go on. "
              "The exit code is 0, 75 if a run was stopped,\n"
              "76 if a row differs by more than its tolerance.",
          [options] { return reproduce(*options); }};
}

}  // namespace skein
