#include <skein/arrays/runtime.hpp>

#include "cli/common_options.hpp"
#include "cli/verbs.hpp"
#include "runs/run_analysis.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

namespace skein {
namespace {

struct AnalyzeOptions {
  std::string folder, output;
  bool json = false, no_forces = false;
  int threads = 0;
};

int print_analysis(const AnalyzeOptions& options) {
  const RunFolder folder = RunFolder::open(options.folder);
  const Runtime runtime(options.threads);
  const RunAnalysis analysis = analyze_run(folder, !options.no_forces);
  write_analysis(analysis, options.output.empty() ? folder.analysis() : std::filesystem::path(options.output));
  fmt::print("{}", options.json ? describe_analysis_as_json(analysis) : describe_analysis(analysis));
  return 0;
}

}  // namespace

void add_analyze_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("analyze", "Measure what the fibers of a run did");
  const auto options = std::make_shared<AnalyzeOptions>();
  verb->add_option("folder", options->folder, "Run folder")->required()->type_name("DIR");
  verb->add_option("-o,--output", options->output, "Folder for the tables")->type_name("FOLDER");
  verb->add_flag("--json", options->json, "The summary as JSON");
  verb->add_flag("--no-forces", options->no_forces, "Shapes only: no energy, power or particle stress");
  add_threads_option(*verb, options->threads);
  verb->footer(
      "Examples:\n"
      "  skein analyze tumbling\n"
      "  skein analyze tumbling --json --no-forces -o tables\n"
      "Tables of all frames go to DIR/analysis: diagnostics.csv and diagnostics.h5. The summary on stdout tells\n"
      "regimes and their times, half periods, hook radius, snaking speed, and how the power balance closes.");
  verb->callback([options, &action] { action = [options] { return print_analysis(*options); }; });
}

}  // namespace skein
