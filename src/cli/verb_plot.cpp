#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/scene/scene_file.hpp>

#include "cli/common_arguments.hpp"
#include "cli/plot_scripts.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"
#include "runs/run_analysis.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
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

// Several pictures are of what `skein analyze` measures. Energies and powers take an evaluation of the fluid for each
// frame, which large runs are asked for only by the verb itself.
void refresh_analysis(const fs::path& path) {
  std::error_code ignored;
  const RunFolder folder = RunFolder::open(path);
  const fs::path tables = folder.analysis() / "diagnostics.h5";
  if (fs::exists(tables, ignored) &&
      fs::last_write_time(tables, ignored) >= fs::last_write_time(folder.index(), ignored))
    return;
  constexpr double most_pairs = 1e11;
  const auto n_nodes = static_cast<double>(count_nodes(make_fibers(read_scene(folder.scene(), {}).config.fibers)));
  const double pairs = n_nodes * n_nodes * static_cast<double>(read_run_summary(path).frames);
  const Runtime runtime;
  write_analysis(analyze_run(folder, pairs <= most_pairs), folder.analysis());
}

int plot_run(const PlotOptions& options) {
  std::error_code error;
  if (!fs::is_directory(options.folder, error)) {
    throw Error(ExitCode::missing_input, fmt::format("the run folder {} is not there", options.folder));
  }
  try {
    refresh_analysis(options.folder);
  } catch (const Error& cause) {  // other pictures may be possible still
    print_warning(fmt::format("the run is not analyzed: {}", cause.what()));
  }
  // Made absolute, so that a folder whose name begins with a dash is no option.
  std::vector<std::string> arguments{fs::absolute(options.folder).string()};
  if (!options.times.empty()) arguments.push_back(fmt::format("--times={}", fmt::join(options.times, ",")));
  if (!options.output.empty()) arguments.push_back("--output=" + options.output);
  arguments.push_back("--format=" + options.format);
  if (options.movie) arguments.push_back("--movie");
  return run_plot_script("plot_run.py", arguments);
}

}  // namespace

Verb make_plot_verb() {
  const auto options = std::make_shared<PlotOptions>();
  return {"plot",
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
          "The run is analyzed first ('skein analyze') if it has changed since the last time.",
          [options] { return plot_run(*options); }};
}

}  // namespace skein
