#include "cli/fresh_tables.hpp"

#include <skein/core/error.hpp>
#include <skein/io/run_scene.hpp>
#include <skein/io/run_summary.hpp>

#include "cli/terminal.hpp"
#include "runs/run_analysis.hpp"

#include <fmt/format.h>

#include <system_error>

namespace skein {
namespace {

namespace fs = std::filesystem;

bool are_up_to_date(const RunFolder& folder) {
  std::error_code ignored;  // what cannot be looked at is made anew
  const fs::path tables = folder.analysis() / "diagnostics.h5";
  return fs::exists(tables, ignored) &&
         fs::last_write_time(tables, ignored) >= fs::last_write_time(folder.index(), ignored);
}

}  // namespace

std::string write_fresh_tables(const fs::path& run, const fs::path& tables) {
  constexpr double most_pairs = 1e11;
  const RunFolder folder = RunFolder::open(run);
  const auto n_nodes = static_cast<double>(count_nodes(make_fibers(read_run_scene(folder).fibers)));
  const double pairs = n_nodes * n_nodes * static_cast<double>(read_run_summary(run).frames);
  const RunAnalysis analysis = analyze_run(folder, pairs <= most_pairs);
  write_analysis(analysis, tables);
  return describe_analysis(analysis);
}

std::optional<fs::path> refresh_tables(const fs::path& run, const fs::path& elsewhere) {
  try {
    const RunFolder folder = RunFolder::open(run);
    if (are_up_to_date(folder)) return folder.analysis();
    const fs::path tables = elsewhere.empty() ? folder.analysis() : elsewhere;
    write_fresh_tables(run, tables);
    return tables;
  } catch (const Error& cause) {
    print_warning(fmt::format("the run is not analyzed: {}", cause.what()));
    return std::nullopt;
  }
}

}  // namespace skein
