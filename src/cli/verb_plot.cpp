#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>
#include <skein/io/listed_segments.hpp>
#include <skein/io/run_scene.hpp>
#include <skein/io/run_summary.hpp>

#include "cli/common_arguments.hpp"
#include "cli/plot_scripts.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"
#include "runs/run_analysis.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
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

/// Several pictures are of what `skein analyze` measures. Energies and powers take an evaluation of the fluid for each
/// frame, which large runs are asked for only by the verb itself.
/// @param results  where tables are written if the run's own are older than the run
/// @returns the folder of tables that are up to date
fs::path refresh_analysis(const RunFolder& folder, const fs::path& results) {
  std::error_code ignored;  // what cannot be looked at is made anew
  const fs::path tables = folder.analysis() / "diagnostics.h5";
  if (fs::exists(tables, ignored) &&
      fs::last_write_time(tables, ignored) >= fs::last_write_time(folder.index(), ignored))
    return folder.analysis();
  constexpr double most_pairs = 1e11;
  const auto n_nodes = static_cast<double>(count_nodes(make_fibers(read_run_scene(folder).fibers)));
  const double pairs = n_nodes * n_nodes * static_cast<double>(read_run_summary(folder.path()).frames);
  const Runtime runtime;
  write_analysis(analyze_run(folder, pairs <= most_pairs), results);
  return results;
}

/// The folder of the run's tables; nothing where they cannot be made: other pictures may be possible still.
std::optional<fs::path> find_tables(const PlotOptions& options) {
  try {
    const RunFolder folder = RunFolder::open(options.folder);
    // A run whose pictures go elsewhere is only read: it may be somebody else's.
    return refresh_analysis(folder, options.output.empty() ? folder.analysis() : fs::path(options.output) / "analysis");
  } catch (const Error& cause) {
    print_warning(fmt::format("the run is not analyzed: {}", cause.what()));
    return std::nullopt;
  }
}

int plot_run(const PlotOptions& options) {
  check_listed_segments(RunFolder::open(options.folder));  // the scripts that draw believe what they read
  // Made absolute, so that a folder whose name begins with a dash is no option.
  std::vector<std::string> arguments{fs::absolute(options.folder).string()};
  if (!options.output.empty()) {
    check_output(options.output, RunFolder::open(options.folder));
    arguments.push_back("--output=" + fs::absolute(options.output).string());
  }
  if (const auto tables = find_tables(options)) arguments.push_back("--tables=" + fs::absolute(*tables).string());
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
