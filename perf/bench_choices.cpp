// What `method = "auto"` takes, beside everything else that it could have taken: direct sums in double, on a device
// also in single (of a host's it promises that they are exact), and the fast multipole method with leaves of half, once
// and twice as many nodes, with and without tails of the blobs. One line for each number of nodes and tolerance, the
// last one with the worst of them. Usage: bench_choices [tiny] [spiral] [least=N] [most=N]   (threads: OMP_NUM_THREADS)

#include <skein/arrays/runtime.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>
#include <skein/physics/mobility_choice.hpp>

#include "harness.hpp"
#include "node_arrangements.hpp"
#include "sum_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace skein;

constexpr double viscosity = 1.0;
constexpr int nodes_per_section = 18;

struct Way {
  std::string name;
  std::unique_ptr<Mobility> mobility;
};

Way make_direct(const Precision precision) {
  return {precision == Precision::in_single ? "direct, single" : "direct, double",
          std::make_unique<DirectMobility>(viscosity, precision)};
}

Way make_fmm(const std::string& name, const FmmOptions& options) {
  return {name, std::make_unique<FmmMobility>(viscosity, options)};
}

SceneConfig make_scene(const int n_nodes, const double tolerance) {
  SceneConfig scene;
  scene.fibers.emplace_back();
  scene.fibers.front().sections = n_nodes / nodes_per_section;
  scene.fibers.front().nodes_per_section = nodes_per_section;
  scene.fibers.front().blob = perf::fiber_blob;
  scene.hydrodynamics.tolerance = tolerance;
  scene.hydrodynamics.check_every = 0;
  return scene;
}

Way make_automatic(const MobilityChoice& choice) {
  if (!choice.is_direct) return make_fmm("auto", choice.fmm);
  Way way = make_direct(choice.precision);
  way.name = "auto";
  return way;
}

/// All but those that take longer than the slowest of the others is likely to.
std::vector<Way> list_ways(const int n_nodes, const MobilityChoice& choice) {
  constexpr int most_by_direct_sums = on_host<ExecSpace> ? 24000 : 400000;
  std::vector<Way> ways;
  if (n_nodes <= most_by_direct_sums) {
    ways.push_back(make_direct(Precision::in_double));
    if (!on_host<ExecSpace> && choice.fmm.tolerance >= 1e-6) ways.push_back(make_direct(Precision::in_single));
  }
  FmmOptions options = choice.fmm;
  options.direct_when_cheaper = false;
  if (needs_direct_sum(options)) return ways;
  const int usual_leaf = choose_fmm_plan(options, perf::fiber_blob, 0).leaf_size;
  for (const double factor : {0.5, 1.0, 2.0})
    for (const int degree : {0, FmmOptions::no_tail}) {
      options.leaf_size = static_cast<int>(factor * usual_leaf);
      options.tail_degree = degree;
      ways.push_back(
          make_fmm(fmt::format("fmm, leaves of {}{}", options.leaf_size, degree == 0 ? "" : ", no tails"), options));
    }
  return ways;
}

/// @returns how much longer than the best of the ways `auto` takes
double compare(const std::vector<Vec3>& nodes, const double tolerance) {
  perf::SumProblem problem(nodes, perf::fiber_blob);
  const MobilityChoice choice = choose_mobility(make_scene(problem.n, tolerance));
  std::vector<Way> ways = list_ways(problem.n, choice);
  ways.push_back(make_automatic(choice));
  std::vector<std::function<void()>> bodies;
  for (const Way& way : ways)
    bodies.emplace_back([&problem, &way] {
      problem.move_nodes();
      problem.compute(*way.mobility);
    });
  const auto seconds = perf::median_seconds(problem.n < 6000 ? 15 : problem.n < 200000 ? 5 : 1, bodies);
  const auto best = static_cast<std::size_t>(std::min_element(seconds.begin(), seconds.end()) - seconds.begin());
  const double ratio = seconds.back() / seconds[best];
  std::printf("%d,%g,\"%s\",%.4f,\"%s\",%.4f,%.2f\n", problem.n, tolerance, choice.is_direct ? "direct" : "fmm",
              1e3 * seconds.back(), ways[best].name.c_str(), 1e3 * seconds[best], ratio);
  std::fflush(stdout);
  return ratio;
}

}  // namespace

int main(int argc, char** argv) {
  const Runtime runtime;
  perf::print_context();
  bool is_tiny = false, is_spiral = false;
  int least = 0, most = 999990;
  for (int a = 1; a < argc; ++a) {
    is_tiny |= std::string_view(argv[a]) == "tiny";
    is_spiral |= std::string_view(argv[a]) == "spiral";
    std::sscanf(argv[a], "least=%d", &least);
    std::sscanf(argv[a], "most=%d", &most);
  }
  if (is_tiny) most = 504;
  std::printf("nodes,tolerance,auto,auto_ms,best,best_ms,auto_over_best\n");
  double worst = 0.0;
  for (const int n : {504, 1008, 1512, 2880, 5418, 10800, 23634, 94536, 378144, 999990})
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8})
      if (n >= least && n <= most)
        worst = std::max(worst, compare(is_spiral ? perf::make_spiral(n) : perf::make_straight(n), tolerance));
  std::printf("# auto takes at most %.2f times as long as the best\n", worst);
  return 0;
}
