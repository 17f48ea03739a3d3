#include <skein/arrays/runtime.hpp>
#include <skein/core/error.hpp>

#include "cli/common_arguments.hpp"
#include "cli/plot_scripts.hpp"
#include "cli/terminal.hpp"
#include "cli/verbs.hpp"
#include "runs/placed_scene.hpp"
#include "studies/contact_study.hpp"
#include "studies/ladder.hpp"
#include "studies/machine_report.hpp"
#include "studies/plan_check.hpp"
#include "studies/rung_name.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

namespace skein {
namespace {

struct BenchOptions {
  std::string what;
  std::filesystem::path folder = "bench";
  std::vector<double> lengths;  ///< empty: the study's own
  std::vector<double> rungs;    ///< empty: the study's own
  std::vector<std::string> scenes;
  std::vector<double> tolerances{0.1, 0.03, 0.01};
  double stiffness = 1.0;
  PlanRequest request;  ///< of the plans, but for its tolerance
  int threads = 0;
  bool no_plots = false;
  bool as_json = false;
  double seconds = 6.0;
};

/// The study with the lengths and rungs that were asked for.
template <class Study>
Study make_study(const BenchOptions& options) {
  Study study;
  if (!options.lengths.empty()) study.lengths = options.lengths;
  if (!options.rungs.empty()) study.rungs.assign(options.rungs.begin(), options.rungs.end());
  return study;
}

void print_point(const LadderPoint& point) {
  std::string errors;
  for (const AnswerError& error : point.errors)
    errors += fmt::format("  {} {:.2g} %", name_of(error.question), 100.0 * error.error);
  print_result(fmt::format("{:<8.3g} {:>5} {:>7} {:>10.3g} {:>9} {}\n", point.length, point.nodes_per_section,
                           point.n_nodes, point.seconds, point.evaluations,
                           errors.empty() ? "  the reference" : errors));
  std::fflush(stdout);
}

int bench_ladder(const BenchOptions& options) {
  const Runtime runtime(options.threads);
  std::error_code error;
  std::filesystem::create_directories(options.folder, error);
  if (error)
    throw Error(ExitCode::cannot_create,
                fmt::format("cannot make the folder '{}': {}", options.folder.string(), error.message()));
  print_result(fmt::format("# {}\n{:<8} {:>5} {:>7} {:>10} {:>9}   {}\n", describe_backend(), "length", "nodes",
                           "in all", "seconds", "evaluations", "errors against the first"));
  auto study = make_study<LadderStudy>(options);
  study.stiffness = options.stiffness;
  write_ladder(options.folder / "ladder.csv", measure_ladder(study, print_point));
  if (options.no_plots) return 0;
  return run_plot_script("plot_ladder.py", {std::filesystem::absolute(options.folder).string(), "--to-stderr"});
}

std::string in_percent(const double error) {
  return std::isfinite(error) ? fmt::format("{:.2g} %", 100.0 * error) : std::string("none");
}

int bench_plans(const BenchOptions& options) {
  if (options.scenes.empty()) throw Error(ExitCode::usage, "bench plan needs scenes: --scene FILE, once for each");
  const Runtime runtime(options.threads);
  print_result(fmt::format("# {}\n{:<26} {:>9} {:>6} {:>10} {:>10} {:>9} {:>9}\n", describe_backend(), "scene",
                           "tolerance", "rung", "predicted", "measured", "seconds", "cheapest"));
  for (const std::string& file : options.scenes) {
    const PlacedScene placed = read_placed_scene(file, {});
    for (const PlanCheck& check : check_plans(placed.config, options.request, options.tolerances, print_note))
      print_result(fmt::format("{:<26} {:>9} {:>6} {:>10} {:>10} {:>9.3g} {:>9.3g}\n",
                               std::filesystem::path(file).stem().string(), in_percent(check.tolerance),
                               check.chosen ? name_of_rung(*check.chosen) : "none", in_percent(check.predicted_error),
                               in_percent(check.measured_error), check.seconds, check.cheapest_seconds));
    std::fflush(stdout);
  }
  return 0;
}

std::string at_time(const double time) { return std::isnan(time) ? std::string("never") : fmt::format("{:.4g}", time); }

void print_contact(const ContactPoint& point) {
  print_result(fmt::format(
      "{:<8.3g} {:>6} {:>6.2f} {:>10.2f} {:>10.3g} {:>9.4g} {:>9} {:>9.2g} {:>9} {:>7} {:>8.2g} % {:>8.3g} {}\n",
      point.length, name_of_rung(point.rung), point.blob_over_spacing, point.stiffness_factor, point.repulsion,
      point.contact.smallest_gap, at_time(point.contact.first_inside), point.contact.depth,
      at_time(point.contact.first_crossing), point.n_crossings, 100.0 * point.shape_change, point.seconds,
      point.failure.empty() ? "" : "broke off"));
  std::fflush(stdout);
}

int bench_contact(const BenchOptions& options) {
  const Runtime runtime(options.threads);
  print_result(fmt::format(
      "# {}\n# gaps and depths in radii; blob in section distances; stiffness times the paper's; shape: what the "
      "repulsion changes before contact\n{:<8} {:>6} {:>6} {:>10} {:>10} {:>9} {:>9} {:>9} {:>9} {:>7} {:>10} {:>8}\n",
      describe_backend(), "length", "rung", "blob", "stiffness", "repulsion", "gap", "inside", "depth", "crossed",
      "times", "shape", "seconds"));
  measure_contact(make_study<ContactStudy>(options), print_contact);
  return 0;
}

constexpr double machine_lengths[] = {0.139, 0.196, 0.523, 0.931, 2.28};  // of the paper's fibers

int bench_machine(const BenchOptions& options) {
  const Runtime runtime(options.threads);
  const std::vector<double> lengths = options.lengths.empty()
                                          ? std::vector<double>(std::begin(machine_lengths), std::end(machine_lengths))
                                          : options.lengths;
  const MachineReport report = measure_machine(describe_backend(), lengths, options.seconds);
  print_result(options.as_json ? write_machine_json(report) + "\n" : describe_machine(report));
  return 0;
}

int bench(const BenchOptions& options) {
  if (options.what == "machine") return bench_machine(options);
  if (options.what == "contact") return bench_contact(options);
  return options.what == "ladder" ? bench_ladder(options) : bench_plans(options);
}

}  // namespace

Verb make_bench_verb() {
  const auto options = std::make_shared<BenchOptions>();
  return {"bench",
          "Measure what this machine and this program can do",
          {make_argument("what", &options->what, "",
                         "machine: this machine's peaks, and sums and steps beside them; ladder: chains and tubes of 4 "
                         "to 24 nodes on a section, errors against cost; plan: what "
                         "'skein plan' promises of scenes, and what comes of it; contact: how deep long fibers are "
                         "pressed into themselves")
               .among({"machine", "ladder", "plan", "contact"})
               .require(),
           make_argument("-o,--output", &options->folder, "FOLDER", "Folder for table and picture"),
           make_argument("--lengths", &options->lengths, "L,...", "Of the paper's fibers").within(0.02, 3.0),
           make_argument("--rungs", &options->rungs, "N,...",
                         "Nodes on a section, 1 for the chain, 0 for rigid fibers; the first is what the others are "
                         "compared with")
               .within(0, 24),
           make_argument("--stiffness", &options->stiffness, "F", "Of the ladder's springs, times the paper's")
               .within(1e-2, 1e3),
           make_argument("--scene", &options->scenes, "FILE", "To be planned; once for each"),
           make_argument("--tolerances", &options->tolerances, "E,...", "Of the plans").within(1e-4, 0.5),
           make_argument("--within", Duration{&options->request.max_seconds}, "T",
                         "Wall time for the pilot runs of a plan: seconds, 30m, 2h or 1:30:00"),
           make_threads_option(&options->threads), make_flag("--no-plots", &options->no_plots, "Draw nothing"),
           make_argument("--seconds", &options->seconds, "S",
                         "Of the machine: for the steps of each length, and at most for one direct sum")
               .within(0.01, 60.0),
           make_flag("--json", &options->as_json, "Of the machine: one JSON object instead of tables")},
          "Examples:\n"
          "  skein bench machine\n"
          "  skein bench ladder\n"
          "  skein bench ladder -o short --lengths 0.139,0.196\n"
          "  skein bench plan --scene configs/tumbling.toml --scene configs/buckling_C.toml\n"
          "The ladder of all four lengths takes a quarter of an hour on two cores, of the first two two minutes; the "
          "machine takes less than three.",
          [options] { return bench(*options); }};
}

}  // namespace skein
