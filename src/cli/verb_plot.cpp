#include <skein/arrays/runtime.hpp>
#include <skein/io/listed_segments.hpp>
#include <skein/io/run_folder.hpp>

#include "cli/common_arguments.hpp"
#include "cli/fresh_tables.hpp"
#include "cli/plot_scripts.hpp"
#include "cli/verbs.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace skein {
namespace {

namespace fs = std::filesystem;

struct PlotOptions {
  std::string folder;
  std::vector<double> times;
  std::string output, format = "png";
  bool movie = false;
};

int plot_run(const PlotOptions& options) {
  check_listed_segments(RunFolder::open(options.folder));  // the scripts that draw believe what they read
  // Made absolute, so that a folder whose name begins with a dash is no option.
  std::vector<std::string> arguments{fs::absolute(options.folder).string()};
  if (!options.output.empty()) {
    check_output(options.output, RunFolder::open(options.folder));
    arguments.push_back("--output=" + fs::absolute(options.output).string());
  }
  {
    const Runtime runtime;
    // A run whose pictures go elsewhere is only read: it may be somebody else's.
    const fs::path tables = options.output.empty() ? fs::path() : fs::path(options.output) / "analysis";
    if (const auto fresh = refresh_tables(options.folder, tables))
      arguments.push_back("--tables=" + fs::absolute(*fresh).string());
  }
  if (!options.times.empty()) arguments.push_back(fmt::format("--times={}", fmt::join(options.times, ",")));
  arguments.push_back("--format=" + options.format);
  if (options.movie) arguments.push_back("--movie");
  return run_plot_script("plot_run.py", arguments);
}

}  // namespace

Verb make_plot_verb() {
  const auto options = std::make_shared<PlotOptions>();
  return {
      "plot",
      "Draw a run",
      {make_folder_argument(&options->folder),
       make_argument("--times", &options->times, "T1,T2,...", "Draw the frames nearest to these times"),
       make_argument("-o,--output", &options->output, "FOLDER", "Folder for the pictures"),
       make_argument("--format", &options->format, "png|pdf|svg", "Of the pictures; png without")
           .among({"png", "pdf", "svg"}),
       make_flag("--movie", &options->movie, "Also movie.mp4, for which ffmpeg must be installed")},
      "Examples:\n"
      "  skein plot tumbling\n"
      "  skein plot tumbling --times 4.95,5.44,10.9 -o pictures --format pdf\n"
      "  skein plot tumbling --movie\n"
      "The run is analyzed first ('skein analyze') if it has changed since the last time. With -o nothing is written\n"
      "into the run's own folder: the tables go to FOLDER/analysis.",
      [options] { return plot_run(*options); }};
}

}  // namespace skein
