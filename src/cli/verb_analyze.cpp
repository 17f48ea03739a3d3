#include <skein/arrays/runtime.hpp>

#include "cli/common_arguments.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"
#include "runs/run_analysis.hpp"

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
  if (!options.output.empty()) check_output(options.output, folder);
  const Runtime runtime(options.threads);
  const RunAnalysis analysis = analyze_run(folder, !options.no_forces);
  write_analysis(analysis, options.output.empty() ? folder.analysis() : std::filesystem::path(options.output));
  print_result(options.json ? describe_analysis_as_json(analysis) : describe_analysis(analysis));
  return 0;
}

}  // namespace

Verb make_analyze_verb() {
  const auto options = std::make_shared<AnalyzeOptions>();
  return {"analyze",
          "Measure what the fibers of a run did",
          {make_folder_argument(&options->folder),
           make_argument("-o,--output", &options->output, "FOLDER", "Folder for the tables"),
           make_flag("--json", &options->json, "The summary as JSON"),
           make_flag("--no-forces", &options->no_forces, "Shapes only: no energy, power or particle stress"),
           make_threads_option(&options->threads)},
          "Examples:\n"
          "  skein analyze tumbling\n"
          "  skein analyze tumbling --json --no-forces -o tables\n"
          "Tables of all frames go to DIR/analysis: diagnostics.csv and diagnostics.h5. The summary on stdout tells\n"
          "regimes and their times, half periods, hook radius, snaking speed, and how the power balance closes.",
          [options] { return print_analysis(*options); }};
}

}  // namespace skein
