// Time against error, for the chart: what each tolerance costs by the fast multipole method, what its other far fields
// cost by their order, and the direct sums, on two tubes, a coil and a cube. Usage: bench_chart [tiny] > chart.csv;
// perf/plot_fmm.py chart.csv chart.png (threads: OMP_NUM_THREADS)

#include <skein/arrays/runtime.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>
#include <skein/scene/words.hpp>

#include "harness.hpp"
#include "node_arrangements.hpp"
#include "sum_problem.hpp"

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace skein;
using namespace skein::perf;

constexpr double viscosity = 1.7;

struct Panel {
  std::string shape;
  SumProblem problem;
  int repeats;
};

void print_row(const Panel& panel, const std::string& method, const int order, const double seconds,
               const double error) {
  std::printf("%s,%d,%s,%d,%.4f,%.2e\n", panel.shape.c_str(), panel.problem.n, method.c_str(), order, 1e3 * seconds,
              error);
  std::fflush(stdout);
}

void chart_direct_sums(Panel& panel) {
  DirectMobility direct(viscosity, Precision::in_double), in_single(viscosity, Precision::in_single);
  SumProblem& problem = panel.problem;
  const auto seconds = median_seconds(
      panel.repeats,
      std::vector<std::function<void()>>{[&] { problem.compute(direct); }, [&] { problem.compute(in_single); }});
  problem.compute(direct);
  const auto exact = to_host(problem.velocity);
  problem.compute(in_single);
  print_row(panel, "direct_double", 0, seconds[0], 1e-15);
  print_row(panel, "direct_single", 0, seconds[1], relative_error(to_host(problem.velocity), exact));
}

/// With nodes that move before every evaluation: the tree and its lists count.
void chart_fmm(Panel& panel, const FmmOptions& options) {
  FmmMobility fmm(viscosity, options);
  SumProblem& problem = panel.problem;
  const auto evaluate = [&] {
    problem.move_nodes();
    problem.compute(fmm);
  };
  const double seconds = median_seconds(panel.repeats, std::vector<std::function<void()>>{evaluate}).front();
  print_row(panel, "fmm_" + word_of(options.far_field), fmm.statistics().plan.order, seconds,
            fmm.measure_error(problem.sources(), problem.position, 300));
}

void chart_tolerances(Panel& panel) {
  for (const double tolerance : {5e-3, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
    FmmOptions options;
    options.tolerance = tolerance;
    chart_fmm(panel, options);
  }
}

/// Far fields whose tables promise less than they keep: by order, with leaves as the harmonic field's of that order
/// would be without tails.
void chart_orders(Panel& panel, const FarField field) {
  for (int p = 4; p <= (field == FarField::regularized ? 10 : 12); p += 2) {
    FmmOptions harmonic;
    harmonic.tolerance = 1.0;
    harmonic.order = p;
    harmonic.precision = Precision::in_double;
    FmmOptions options;
    options.far_field = field;
    options.order = p;
    options.tolerance = 1.0;
    options.min_half_width = fiber_blob * std::pow(0.011 / choose_fmm_plan(harmonic, 0.0, 0).expected_error, 0.25);
    if (panel.shape == "straight" && options.min_half_width > tube_length(panel.problem.n) / 6.0) continue;
    chart_fmm(panel, options);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Runtime runtime;
  print_context();
  const bool is_tiny = argc > 1 && std::string_view(argv[1]) == "tiny";
  const int n_uniform = 100000;
  std::printf("shape,nodes,method,p,ms,error\n");
  std::vector<std::function<Panel()>> panels = {[] {
    return Panel{"straight", {make_straight(1440), fiber_blob}, 15};
  }};
  if (!is_tiny) {
    panels.emplace_back([] { return Panel{"straight", {make_straight(23634), fiber_blob}, 5}; });
    panels.emplace_back([] { return Panel{"spiral", {make_spiral(23634), fiber_blob}, 5}; });
    panels.emplace_back([] { return Panel{"uniform", {make_uniform(n_uniform), 0.1 / std::cbrt(n_uniform)}, 3}; });
  }
  for (const auto& make : panels) {
    Panel panel = make();
    chart_direct_sums(panel);
    chart_tolerances(panel);
    if (is_tiny) continue;
    chart_orders(panel, FarField::stokeslet);
    chart_orders(panel, FarField::regularized);
  }
  return 0;
}
