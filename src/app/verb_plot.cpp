#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <skein/core/error.hpp>
#include <string>
#include <system_error>
#include <vector>

#include "app/plot_scripts.hpp"
#include "app/verbs.hpp"

namespace skein {
namespace {

namespace fs = std::filesystem;

struct PlotOptions {
  std::string folder;
  std::vector<double> times;
  std::string output;
};

int plot_run(const PlotOptions& options) {
  std::error_code error;
  if (!fs::is_directory(options.folder, error)) {
    throw Error(ExitCode::missing_input, fmt::format("the run folder {} is not there", options.folder));
  }
  // Made absolute, so that a folder whose name begins with a dash is no option.
  std::vector<std::string> arguments{fs::absolute(options.folder).string()};
  if (!options.times.empty()) arguments.push_back(fmt::format("--times={}", fmt::join(options.times, ",")));
  if (!options.output.empty()) arguments.push_back("--output=" + options.output);
  return run_plot_script("plot_run.py", arguments);
}

}  // namespace

void add_plot_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("plot", "Draw a run");
  const auto options = std::make_shared<PlotOptions>();
  verb->add_option("folder", options->folder, "Run folder")->required()->type_name("DIR");
  verb->add_option("--times", options->times, "Draw the frames nearest to these times")
      ->type_name("T1,T2,...")
      ->delimiter(',');
  verb->add_option("-o,--output", options->output, "Folder for the pictures")->type_name("FOLDER");
  verb->footer(
      "Examples:\n"
      "  skein plot tumbling\n"
      "  skein plot tumbling --times 4.95,5.44,10.9 -o pictures");
  verb->callback([options, &action] { action = [options] { return plot_run(*options); }; });
}

}  // namespace skein
