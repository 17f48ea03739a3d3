#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>
#include <skein/fibers/calibration.hpp>
#include <skein/io/array_file.hpp>
#include <skein/scene/scene_file.hpp>

#include "cli/common_options.hpp"
#include "cli/plot_scripts.hpp"
#include "cli/terminal_listener.hpp"
#include "cli/verbs.hpp"
#include "runs/run_analysis.hpp"
#include "runs/run_to_end.hpp"
#include "studies/paper_scenes.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace skein {
namespace {

namespace fs = std::filesystem;

struct PhaseOptions {
  std::string output = "phases";
  double from = 0.08, to = 0.6, end = 30.0;
  int count = 20, nodes_per_section = 18, threads = 0;
  std::vector<std::string> perturbation;  ///< overrides
  double max_walltime = std::numeric_limits<double>::infinity();
  bool quiet = false, no_plots = false;
};

/// One point of the diagram.
struct PhasePoint {
  std::string folder;
  bool is_perturbed = false;
  SceneConfig scene;
};

SceneConfig perturb(const SceneConfig& scene, const std::vector<std::string>& overrides) {
  return read_scene_text(write_scene(scene), "the perturbed scene", overrides).config;
}

std::vector<PhasePoint> list_points(const PhaseOptions& options) {
  const double spacing = make_fibers(make_paper_scene(80, 1.0).fibers)[0].spacing();
  std::vector<PhasePoint> points;
  for (const bool is_perturbed : {false, true}) {
    if (is_perturbed && options.perturbation.empty()) continue;
    for (int i = 0; i < options.count; ++i) {
      const double length =
          options.count == 1 ? options.from : options.from + (options.to - options.from) * i / (options.count - 1);
      const int sections = std::max(2, static_cast<int>(std::lround(length / spacing)));
      SceneConfig scene = coarsen(make_paper_scene(sections, options.end), options.nodes_per_section);
      if (is_perturbed) scene = perturb(scene, options.perturbation);
      points.push_back(
          {fmt::format("{}_{:04}_{}", is_perturbed ? "perturbed" : "straight", sections, options.nodes_per_section),
           is_perturbed, scene});
    }
  }
  return points;
}

/// Rows of phases.csv.
class PhaseTable {
 public:
  void add(const PhasePoint& point, const RunAnalysis& analysis) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const FiberSummary summary = analysis.histories[0].summarize();
    const Fiber& fiber = analysis.fibers[0];
    const double number =
        compute_elasto_viscous_numbers(fiber, point.scene.fluid.viscosity, 2.5, measure_beam_stiffness(fiber).bending)
            .with_log_4e_over_rho2;
    const std::vector<double> row{fiber.length(),
                                  number,
                                  static_cast<double>(point.is_perturbed),
                                  static_cast<double>(summary.regime),
                                  summary.half_periods.empty() ? none : summary.half_periods[0],
                                  summary.curvature_max,
                                  static_cast<double>(summary.wave),
                                  summary.snaking ? summary.snaking->hook_radius : none,
                                  summary.snaking ? summary.snaking->speed : none,
                                  summary.symmetry_defect_max,
                                  summary.out_of_plane_max};
    for (std::size_t c = 0; c < columns_.size(); ++c) columns_[c].values.push_back(row[c]);
    fmt::print("{:<10.4g} {:<10.4g} {:<10} {}\n", fiber.length(), number, point.is_perturbed ? "perturbed" : "straight",
               name_of(summary.regime));
  }
  void write(const fs::path& path) const { write_csv(path, columns_); }

 private:
  std::vector<NamedArray> columns_{{"length", "length", {}, {}},
                                   {"elasto_viscous_number", "", {}, {}},
                                   {"perturbed", "", {}, {}},
                                   {"regime", "", {}, {}},
                                   {"half_period", "time", {}, {}},
                                   {"curvature_max", "1/length", {}, {}},
                                   {"wave", "", {}, {}},
                                   {"hook_radius", "length", {}, {}},
                                   {"snaking_speed", "length/time", {}, {}},
                                   {"symmetry_defect", "", {}, {}},
                                   {"out_of_plane", "length", {}, {}}};
};

int draw_phases(const PhaseOptions& options) {
  const auto points = list_points(options);
  const Runtime runtime(options.threads);
  fmt::print("{:<10} {:<10} {:<10} {}\n", "length", "mu_bar", "start", "regime");
  PhaseTable table;
  for (const PhasePoint& point : points) {
    const fs::path path = fs::path(options.output) / point.folder;
    TerminalListener listener(options.quiet);
    if (run_to_end(point.scene, path, options.max_walltime, listener) == ExitCode::stopped)
      return static_cast<int>(ExitCode::stopped);
    table.add(point, analyze_run(RunFolder::open(path), false));
    std::fflush(stdout);
    table.write(fs::path(options.output) / "phases.csv");
  }
  if (options.no_plots) return 0;
  return run_plot_script("plot_phases.py", {fs::absolute(options.output).string(), "--to-stderr"});
}

}  // namespace

void add_phases_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("phases", "Draw the regimes of fibers in shear over their length");
  const auto options = std::make_shared<PhaseOptions>();
  verb->add_option("-o,--output", options->output, "Folder for runs, table and picture")->type_name("FOLDER");
  verb->add_option("--from", options->from, "Shortest length")->check(CLI::Range(0.01, 10.0));
  verb->add_option("--to", options->to, "Longest length")->check(CLI::Range(0.01, 10.0));
  verb->add_option("--count", options->count, "Number of lengths")->check(CLI::Range(1, 1000));
  verb->add_option("--end", options->end, "Time to which each fiber is followed")->check(CLI::Range(0.1, 1e4));
  verb->add_option("--nodes-per-section", options->nodes_per_section,
                   "Cheaper fibers of the same bending rigidity: 9 takes a thirtieth")
      ->check(CLI::Range(3, 18));
  verb->add_option("--perturbation", options->perturbation,
                   "Also each fiber with this key of its scene changed; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  add_threads_option(*verb, options->threads);
  add_walltime_option(*verb, options->max_walltime);
  verb->add_flag("--no-plots", options->no_plots, "Draw nothing");
  verb->add_flag("-q,--quiet", options->quiet, "Errors only");
  verb->footer(
      "Examples:\n"
      "  skein phases --nodes-per-section 9 -q\n"
      "  skein phases -o rolled --from 0.15 --to 0.25 --count 11 --perturbation fiber.roll=5.0\n"
      "The fibers are those of LaGrone, Cortez, Yan, Fauci 2019, straight along the flow at first, and once more with "
      "a\n"
      "small bend. Runs that are done are not run again, unfinished ones go on.");
  verb->callback([options, &action] { action = [options] { return draw_phases(*options); }; });
}

}  // namespace skein
