// The rates by which methods, precisions and leaves are chosen, measured on the machine at hand and printed as the
// entries of src/fmm/machine_rates.cpp. Usage: bench_rates [tiny]   (a host: OMP_NUM_THREADS=1)
//
// Two tolerances of one precision make two equations for near pairs and for points of surfaces; translations take what
// is left. least_fmm_nodes and least_leaf_size are read off bench_fmm crossover and bench_fmm device.

#include <skein/arrays/runtime.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include "harness.hpp"
#include "node_arrangements.hpp"
#include "sum_problem.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string_view>

namespace {

using namespace skein;

constexpr double viscosity = 1.0;
constexpr double transfer_work = 0.4;  // as in the table

/// `apart` is the same positions in an array of their own, so that no pair is met once for both.
struct Nodes : perf::SumProblem {
  Vectors apart;

  /// @param blob_spread  the blobs of every second node are so much larger
  Nodes(const std::vector<Vec3>& nodes, const double blob_size, const double blob_spread = 0.0)
      : SumProblem(nodes, blob_size), apart(to_device("apart", nodes)) {
    std::vector<double> blobs(nodes.size(), blob_size);
    for (std::size_t i = 0; i < blobs.size(); i += 2) blobs[i] *= 1.0 + blob_spread;
    blob = to_device("blob", blobs);
  }
  double n_pairs() const { return static_cast<double>(n) * n; }
  double time(Mobility& mobility, const ConstVectors& target) const {
    const int n_calls = on_host<ExecSpace> ? 1 : static_cast<int>(std::clamp(1e9 / n_pairs(), 1.0, 50.0));
    const std::vector<std::function<void()>> bodies = {[&] {
      for (int call = 0; call < n_calls; ++call) mobility.add_velocity(sources(), target, velocity);
    }};
    return perf::median_seconds(3, bodies).front() / n_calls;
  }
};

void print_rate(const char* name, const std::array<double, 2>& nanoseconds) {
  std::printf("    .%s = {%.3g, %.3g},\n", name, nanoseconds[0], nanoseconds[1]);
  std::fflush(stdout);
}

constexpr std::array precisions = {Precision::in_double, Precision::in_single};

void print_direct_sums(const Nodes& few, const Nodes& many) {
  std::array<double, 2> pair{}, symmetric{};
  double least = 0.0;
  for (std::size_t p = 0; p < 2; ++p) {
    DirectMobility mobility(viscosity, precisions[p]);
    pair[p] = 1e9 * many.time(mobility, many.apart) / many.n_pairs();
    symmetric[p] = 1e9 * many.time(mobility, many.position) / many.n_pairs();
    least = std::max(least, 1e9 * few.time(mobility, few.apart) - pair[p] * few.n_pairs());
  }
  print_rate("direct_pair", pair);
  print_rate("symmetric_direct_pair", symmetric);
  std::printf("    .direct_sum = %.3g,\n", least);
}

/// One evaluation: its times in nanoseconds and what they are spent on.
struct Evaluation {
  double near_pairs, surface_points, products;
  double leaves, far, tree, all;
};

Evaluation evaluate(const Nodes& nodes, const double tolerance) {
  FmmOptions options;
  options.tolerance = tolerance;
  FmmMobility mobility(viscosity, options);
  const double seconds = nodes.time(mobility, nodes.position);
  mobility.time_parts();
  mobility.add_velocity(nodes.sources(), nodes.position, nodes.velocity);
  const FmmStatistics& s = mobility.statistics();
  const double n_surface = 6.0 * (s.plan.order - 1) * (s.plan.order - 1) + 2.0, rank = s.plan.rank;
  return {s.work.near_pairs,
          n_surface * s.work.n_targets,
          8.0 * (rank * rank * (transfer_work * s.work.far_pairs + 2.0 * s.work.n_boxes) +
                 2.0 * rank * n_surface * s.work.n_boxes),
          1e9 * s.leaf_seconds,
          1e9 * s.far_seconds,
          1e9 * s.tree_seconds,
          1e9 * seconds};
}

struct FmmRates {
  std::array<double, 2> near_pair{}, surface_pair{}, product{};
  double tree = 0.0;  ///< of the last evaluation
};

FmmRates measure_fmm(const Nodes& nodes) {
  FmmRates rates;
  for (std::size_t p = 0; p < 2; ++p) {
    const bool is_single = precisions[p] == Precision::in_single;
    const Evaluation a = evaluate(nodes, is_single ? 1e-4 : 1e-7), b = evaluate(nodes, is_single ? 1.2e-6 : 1e-9);
    const double determinant = a.near_pairs * b.surface_points - b.near_pairs * a.surface_points;
    rates.near_pair[p] = (a.leaves * b.surface_points - b.leaves * a.surface_points) / determinant;
    rates.surface_pair[p] = (a.near_pairs * b.leaves - b.near_pairs * a.leaves) / determinant;
    const auto product = [&](const Evaluation& e) {
      return (e.far - rates.surface_pair[p] * e.surface_points) / e.products;
    };
    rates.product[p] = std::sqrt(std::max(0.0, product(a)) * std::max(0.0, product(b)));
    rates.tree = b.tree;
  }
  return rates;
}

}  // namespace

int main(int argc, char** argv) {
  const Runtime runtime;
  perf::print_context();
  const bool tiny = argc > 1 && std::string_view(argv[1]) == "tiny";
  const int n_tube = tiny ? 1440 : on_host<ExecSpace> ? 23634 : 94536;
  const int n_cube = tiny ? 3000 : on_host<ExecSpace> ? 50000 : 400000;
  const double cube_blob = 0.1 / std::cbrt(n_cube);
  const Nodes few(perf::make_straight(1440), perf::fiber_blob);
  print_direct_sums(few, Nodes(perf::make_straight(n_tube), perf::fiber_blob));

  const FmmRates equal = measure_fmm(Nodes(perf::make_uniform(n_cube), cube_blob));
  const FmmRates unequal = measure_fmm(Nodes(perf::make_uniform(n_cube), cube_blob, 0.1));
  const Evaluation small = evaluate(Nodes(perf::make_straight(tiny ? 1440 : 5418), perf::fiber_blob), 1e-4);
  print_rate("near_pair", unequal.near_pair);
  print_rate("symmetric_near_pair", equal.near_pair);
  print_rate("surface_pair", equal.surface_pair);
  print_rate("product", equal.product);
  std::printf("    .transfer_work = %g,\n    .node = %.3g,\n    .tree = %.3g,\n", transfer_work,
              std::max(0.0, equal.tree - small.tree) / (2.0 * n_cube), small.all);
  return 0;
}
