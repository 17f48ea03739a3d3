#include "studies/machine_report.hpp"

#include <skein/core/json.hpp>

#include "studies/paper_scenes.hpp"

#include <fmt/format.h>

namespace skein {
namespace {

/// Sections of straight fibers that are summed over.
constexpr int direct_sections[] = {80, 301, 1313, 5252, 21008};
constexpr int fmm_sections[] = {1313, 5252};

FiberConfig make_fiber(const int sections) { return make_paper_scene(sections, 1.0).fibers.front(); }

const char* name_of(const Precision precision) { return precision == Precision::in_single ? "single" : "double"; }

/// Sizes are left out that would take longer, by the one before.
std::vector<DirectTiming> time_direct_sums(const double longest) {
  std::vector<DirectTiming> timings;
  for (const Precision precision : {Precision::in_double, Precision::in_single}) {
    double seconds_per_pair = 0.0;
    for (const int sections : direct_sections) {
      const double n_nodes = static_cast<double>(sections) * paper_nodes_per_section;
      if (seconds_per_pair * n_nodes * n_nodes > longest) break;
      timings.push_back(time_direct(make_fiber(sections), precision));
      seconds_per_pair = 1.0 / timings.back().pairs_per_second();
    }
  }
  return timings;
}

}  // namespace

double MachineReport::share_of_peak(const DirectTiming& timing) const {
  const double peak = timing.precision == Precision::in_single ? peaks.single_operations : peaks.double_operations;
  return timing.pairs_per_second() * operations_per_pair(timing.precision) / peak;
}

MachineReport measure_machine(const std::string& device, const std::vector<double>& lengths,
                              const double seconds_each) {
  MachineReport report;
  report.device = device;
  report.peaks = measure_machine_peaks();
  report.direct = time_direct_sums(seconds_each);
  for (const int sections : fmm_sections)
    for (const double tolerance : {1e-4, 1e-6}) report.fmm.push_back(time_fmm(make_fiber(sections), tolerance));
  for (const double length : lengths)
    report.lengths.push_back(
        {length, time_steps(make_paper_scene(count_paper_sections(length), 1000.0), seconds_each)});
  return report;
}

std::string describe_machine(const MachineReport& report) {
  const MachinePeaks& peaks = report.peaks;
  std::string text = fmt::format(
      "# {}\npeaks: {:.3g} and {:.3g} operations/s in double and single, {:.3g} bytes/s; a launch {:.2g} us, one in "
      "a graph {:.2g} us, one that is waited for {:.2g} us\n",
      report.device, peaks.double_operations, peaks.single_operations, peaks.bandwidth, 1e6 * peaks.launch,
      1e6 * peaks.graph, 1e6 * peaks.wait);
  text += fmt::format("\n{:<14} {:>8} {:>10} {:>11} {:>10} {:>13}\n", "direct sums", "nodes", "precision", "ms",
                      "pairs/s", "of the peak");
  for (const DirectTiming& timing : report.direct)
    text += fmt::format("{:<14} {:>8} {:>10} {:>11.4g} {:>10.3g} {:>11.0f} %\n", "", timing.n_nodes,
                        name_of(timing.precision), 1e3 * timing.seconds, timing.pairs_per_second(),
                        100.0 * report.share_of_peak(timing));
  text += fmt::format("\n{:<14} {:>8} {:>10} {:>11} {:>10} {:>8} {:>8} {:>8} {:>8} {:>9}\n", "fast multipole", "nodes",
                      "tolerance", "ms", "nodes/s", "tree", "sort", "far", "leaves", "error");
  for (const FmmTiming& timing : report.fmm)
    text += fmt::format("{:<14} {:>8} {:>10g} {:>11.4g} {:>10.3g} {:>8.3g} {:>8.3g} {:>8.3g} {:>8.3g} {:>9.1e}\n", "",
                        timing.n_nodes, timing.tolerance, 1e3 * timing.seconds, timing.n_nodes / timing.seconds,
                        1e3 * timing.tree, 1e3 * timing.sort, 1e3 * timing.far, 1e3 * timing.leaves, timing.error);
  text += fmt::format("\n{:<14} {:>8} {:>10} {:>11} {:>10} {:>8} {:>8} {:>8}  {}\n", "steps", "length", "nodes",
                      "ms/eval.", "s/time", "fluid", "springs", "rest", "velocities");
  for (const auto& [length, steps] : report.lengths)
    text += fmt::format("{:<14} {:>8g} {:>10} {:>11.4g} {:>10.3g} {:>6.0f} % {:>6.0f} % {:>6.0f} %  {}\n", "", length,
                        steps.n_nodes, 1e3 * steps.seconds_per_evaluation(), steps.seconds_per_time(),
                        100.0 * steps.fluid_share, 100.0 * steps.springs_share,
                        100.0 * (1.0 - steps.fluid_share - steps.springs_share),
                        steps.mobility.substr(0, steps.mobility.find(',')));
  return text;
}

std::string write_machine_json(const MachineReport& report) {
  const MachinePeaks& peaks = report.peaks;
  JsonWriter json(2);
  json.begin_object().member("device", report.device);
  json.key("peaks").begin_object();
  json.member("double_operations_per_second", peaks.double_operations);
  json.member("single_operations_per_second", peaks.single_operations);
  json.member("bytes_per_second", peaks.bandwidth);
  json.member("launch_seconds", peaks.launch).member("graph_launch_seconds", peaks.graph);
  json.member("wait_seconds", peaks.wait).end_object();
  json.key("direct").begin_array();
  for (const DirectTiming& timing : report.direct) {
    json.begin_object().member("nodes", timing.n_nodes).member("precision", name_of(timing.precision));
    json.member("seconds", timing.seconds).member("pairs_per_second", timing.pairs_per_second());
    json.member("share_of_peak", report.share_of_peak(timing)).end_object();
  }
  json.end_array().key("fmm").begin_array();
  for (const FmmTiming& timing : report.fmm) {
    json.begin_object().member("nodes", timing.n_nodes).member("tolerance", timing.tolerance);
    json.member("error", timing.error).member("seconds", timing.seconds);
    json.member("tree_seconds", timing.tree).member("sort_seconds", timing.sort);
    json.member("far_seconds", timing.far).member("leaf_seconds", timing.leaves).end_object();
  }
  json.end_array().key("lengths").begin_array();
  for (const auto& [length, steps] : report.lengths) {
    json.begin_object().member("length", length).member("nodes", steps.n_nodes);
    json.member("velocities", steps.mobility);
    json.member("seconds_per_evaluation", steps.seconds_per_evaluation());
    json.member("seconds_per_time", steps.seconds_per_time());
    json.member("fluid_share", steps.fluid_share).member("springs_share", steps.springs_share).end_object();
  }
  return json.end_array().end_object().take();
}

}  // namespace skein
