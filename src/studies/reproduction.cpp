#include "studies/reproduction.hpp"

#include <skein/io/folder_listing.hpp>

#include "runs/run_to_end.hpp"
#include "studies/rung_name.hpp"

#include <algorithm>

namespace skein {
namespace {

namespace fs = std::filesystem;

bool holds(const std::vector<Figure>& figures, const Figure figure) {
  return std::find(figures.begin(), figures.end(), figure) != figures.end();
}

bool is_needed(const PaperFiber& fiber, const std::vector<Figure>& figures) {
  return std::any_of(figures.begin(), figures.end(), [&](const Figure figure) { return holds(fiber.figures, figure); });
}

fs::path folder_of(const PaperFiber& fiber, const Reproduction& request) {
  const std::string suffix = request.rung ? "_" + name_of_rung(*request.rung) : "";
  return request.folder / (fiber.name + suffix);
}

ExitCode run_needed(const Reproduction& request, RunListener& listener) {
  for (const PaperFiber& fiber : list_paper_fibers()) {
    if (request.only_compare || !is_needed(fiber, request.figures)) continue;
    const SceneConfig scene = make_run_scene(fiber, request.rung.value_or(fiber.rung));
    if (run_to_end(scene, folder_of(fiber, request), request.max_walltime, listener) == ExitCode::stopped)
      return ExitCode::stopped;
  }
  return ExitCode::done;
}

// Of all runs that are there, also of those that other figures asked for.
PaperRuns analyze_runs(const Reproduction& request) {
  PaperRuns runs;
  for (const PaperFiber& fiber : list_paper_fibers()) {
    const fs::path path = folder_of(fiber, request);
    if (!is_there(path / "trajectory.h5")) continue;
    const RunFolder folder = RunFolder::open(path);
    RunAnalysis analysis = analyze_run(folder, /*with_forces=*/true);
    write_analysis(analysis, folder.analysis());
    runs.emplace(fiber.name, std::move(analysis));
  }
  return runs;
}

}  // namespace

const std::vector<Figure>& list_quick_figures() {
  static const std::vector<Figure> figures{Figure::table1, Figure::figure2, Figure::figure3, Figure::figure7};
  return figures;
}

ReproductionResult reproduce_figures(const Reproduction& request, RunListener& listener) {
  ReproductionResult result;
  result.code = run_needed(request, listener);
  const auto& fibers = list_paper_fibers();
  const bool needs_runs = std::any_of(fibers.begin(), fibers.end(),
                                      [&](const PaperFiber& fiber) { return is_needed(fiber, request.figures); });
  const PaperRuns runs = needs_runs ? analyze_runs(request) : PaperRuns{};
  fs::create_directories(request.folder);
  std::vector<SumTiming> timings;
  if (holds(request.figures, Figure::figure8) && !request.only_compare) {
    timings = time_paper_sums();
    write_timings_csv(request.folder / "timings.csv", timings);
  }
  for (const Figure figure : request.figures)
    for (AcceptanceRow& row : compare_with_paper(figure, runs, timings)) result.rows.push_back(std::move(row));
  write_rows_csv(request.folder / "comparison.csv", result.rows);
  return result;
}

}  // namespace skein
