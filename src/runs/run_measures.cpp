#include "runs/run_measures.hpp"

#include <skein/fibers/calibration.hpp>
#include <skein/io/run_summary.hpp>
#include <skein/physics/flow_summary.hpp>

#include "runs/run_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace skein {
namespace {

constexpr double unanswered = std::numeric_limits<double>::quiet_NaN();

struct RunView {
  const RunAnalysis& analysis;
  const RunSummary& summary;
};

struct RunRow {
  MeasuredQuantity quantity;
  double (*measure)(const RunView&);
};

template <class Values>
double find_largest(const Values& values) {
  return static_cast<double>(*std::max_element(values.begin(), values.end()));
}

constexpr RunRow run_rows[] = {
    {{"frames", "", "frames"}, [](const RunView& run) { return static_cast<double>(run.analysis.time.size()); }},
    {{"steps", "", "accepted steps"}, [](const RunView& run) { return static_cast<double>(run.summary.steps); }},
    {{"last_time", "time", "of the last frame"}, [](const RunView& run) { return run.analysis.time.back(); }},
    {{"smallest_gap", "length", "between surfaces, over all frames"},
     [](const RunView& run) {
       return *std::min_element(run.analysis.smallest_gap.begin(), run.analysis.smallest_gap.end());
     }},
    {{"nodes_inside", "", "of another surface, in the worst frame"},
     [](const RunView& run) { return find_largest(run.analysis.nodes_inside); }},
    {{"depth", "length", "of the deepest of them"},
     [](const RunView& run) { return find_largest(run.analysis.depth); }},
    {{"crossings", "", "passages of centrelines through each other"},
     [](const RunView& run) { return static_cast<double>(run.analysis.crossings.back()); }},
};

struct FiberView {
  const Fiber& fiber;
  const FiberSummary& summary;
  double elasto_viscous_number;
};

struct FiberRow {
  MeasuredQuantity quantity;
  OverFibers over_fibers;
  double (*measure)(const FiberView&);
};

constexpr FiberRow fiber_rows[] = {
    {{"length", "length", "N_f ds"}, OverFibers::mean, [](const FiberView& v) { return v.fiber.length(); }},
    {{"elasto_viscous_number", "", "8 pi mu rate L^4/(c EI), c = ln(4e/rho^2), EI of rigid sections"},
     OverFibers::mean,
     [](const FiberView& v) { return v.elasto_viscous_number; }},
    {{"regime", "", "the most complex one reached: 0 tumble, 1 C, 2 S, 3 snake, 4 coil, 5 three-dimensional"},
     OverFibers::largest,
     [](const FiberView& v) { return static_cast<double>(v.summary.regime); }},
    {{"half_period", "time", "the first"},
     OverFibers::mean,
     [](const FiberView& v) { return v.summary.half_periods.empty() ? unanswered : v.summary.half_periods[0]; }},
    {{"half_turns", "", "since the start"},
     OverFibers::mean,
     [](const FiberView& v) { return static_cast<double>(v.summary.half_periods.size()); }},
    {{"curvature_max", "1/length", "the largest curvature"},
     OverFibers::largest,
     [](const FiberView& v) { return v.summary.curvature_max; }},
    {{"stretch_min", "", "length over the first less 1, at least"},
     OverFibers::smallest,
     [](const FiberView& v) { return v.summary.stretch_min; }},
    {{"stretch_max", "", "length over the first less 1, at most"},
     OverFibers::largest,
     [](const FiberView& v) { return v.summary.stretch_max; }},
    {{"wave", "", "of the extrema of curvature: 0 standing, 1 travelling, 2 unclear"},
     OverFibers::largest,
     [](const FiberView& v) { return static_cast<double>(v.summary.wave); }},
    {{"hook_radius", "length", "while hooks are new"},
     OverFibers::mean,
     [](const FiberView& v) { return v.summary.snaking ? v.summary.snaking->hook_radius : unanswered; }},
    {{"snaking_speed", "length/time", "of the hooks along the fiber"},
     OverFibers::mean,
     [](const FiberView& v) { return v.summary.snaking ? v.summary.snaking->speed : unanswered; }},
    {{"symmetry_defect", "", "over the centreline's length, at most"},
     OverFibers::largest,
     [](const FiberView& v) { return v.summary.symmetry_defect_max; }},
    {{"out_of_plane", "length", "of the fiber's own plane, at most"},
     OverFibers::largest,
     [](const FiberView& v) { return v.summary.out_of_plane_max; }},
    {{"out_of_flow_plane", "length", "at most"},
     OverFibers::largest,
     [](const FiberView& v) { return v.summary.out_of_flow_plane_max.value_or(unanswered); }},
    {{"out_of_plane_growth", "1/time", "rate"},
     OverFibers::largest,
     [](const FiberView& v) { return v.summary.out_of_plane_growth.slope; }},
    {{"deflection_growth", "1/time", "rate of the first bend that grows"},
     OverFibers::largest,
     [](const FiberView& v) { return v.summary.deflection_growth.slope; }},
    {{"deflection_growth_r2", "", "of that line fit"},
     OverFibers::smallest,
     [](const FiberView& v) { return v.summary.deflection_growth.determination; }},
};

template <class Rows>
std::vector<MeasuredQuantity> list_quantities(const Rows& rows) {
  std::vector<MeasuredQuantity> quantities;
  for (const auto& row : rows) quantities.push_back(row.quantity);
  return quantities;
}

/// Copies of one fiber, wherever they are, have one rigidity, which takes longer to find than all else.
bool is_alike(FiberConfig a, const FiberConfig& b) {
  a.center = b.center;
  a.direction = b.direction;
  a.roll = b.roll;
  return a == b;
}

}  // namespace

const std::vector<MeasuredQuantity>& list_run_quantities() {
  static const std::vector<MeasuredQuantity> quantities = list_quantities(run_rows);
  return quantities;
}

const std::vector<MeasuredQuantity>& list_fiber_quantities() {
  static const std::vector<MeasuredQuantity> quantities = list_quantities(fiber_rows);
  return quantities;
}

OverFibers combines_as(const std::size_t fiber_quantity) { return fiber_rows[fiber_quantity].over_fibers; }

double RunMeasures::over_fibers(const std::size_t quantity) const {
  double sum = 0.0, low = unanswered, high = unanswered;
  int n = 0;
  for (std::size_t fiber = 0; fiber < n_fibers(); ++fiber) {
    const double value = of_fiber(fiber, quantity);
    if (std::isnan(value)) continue;
    sum += value;
    low = std::fmin(low, value);
    high = std::fmax(high, value);
    ++n;
  }
  switch (combines_as(quantity)) {
    case OverFibers::largest:
      return high;
    case OverFibers::smallest:
      return low;
    case OverFibers::mean:
      return n > 0 ? sum / n : unanswered;
  }
  return unanswered;
}

RunMeasures measure_run(const RunFolder& folder) {
  const RunAnalysis analysis = analyze_run(folder, /*with_forces=*/false);
  const RunSummary summary = read_run_summary(folder.path());
  RunMeasures measures;
  for (const RunRow& row : run_rows) measures.of_run.push_back(row.measure({analysis, summary}));
  const double rate = summarize_flow(analysis.scene.flows).typical_rate;
  double bending = 0.0;
  for (std::size_t f = 0; f < analysis.fibers.size(); ++f) {
    const Fiber& fiber = analysis.fibers[f];
    if (f == 0 || !is_alike(fiber.config, analysis.fibers[f - 1].config))
      bending = measure_beam_stiffness(fiber).bending;
    const double number =
        compute_elasto_viscous_numbers(fiber, analysis.scene.fluid.viscosity, rate, bending).with_log_4e_over_rho2;
    const FiberSummary of_fiber = analysis.histories[f].summarize();
    for (const FiberRow& row : fiber_rows) measures.of_fibers.push_back(row.measure({fiber, of_fiber, number}));
  }
  return measures;
}

}  // namespace skein
