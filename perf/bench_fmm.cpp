// The fast multipole method against this project's direct sum in the same run: error against order, speed against
// error, crossover, growth with the number of nodes, set-up. Nodes move a little before every evaluation, so the tree
// and its lists count. Usage: bench_fmm [pair] [sixteen] [speed] [step] [crossover] [uniform [only=N]] [setup]
// [device [leaves] [only=N]] [tiny] (threads: OMP_NUM_THREADS). "device" times the path through the execution space's
// memory, on hosts only when asked.

#include <skein/arrays/runtime.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>
#include <skein/scene/words.hpp>

#include "harness.hpp"
#include "node_arrangements.hpp"
#include "sum_problem.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>
#include <string>

namespace {

using namespace skein;
using namespace skein::perf;

constexpr double viscosity = 1.7;

using Case = SumProblem;

struct Outcome {
  double seconds, direct_seconds, error;
  FmmStatistics statistics;
};

/// Time of one evaluation and of one direct sum, taking turns; error of all targets, or of a sample where a direct sum
/// would take too long.
Outcome measure(Case& problem, const FmmOptions& options, const int repeats, const bool with_direct) {
  FmmMobility fmm(viscosity, options);
  DirectMobility direct(viscosity, Precision::in_double);
  std::vector<std::function<void()>> bodies = {[&] {
    problem.move_nodes();
    problem.compute(fmm);
  }};
  if (with_direct)
    bodies.push_back([&] {
      problem.move_nodes();
      problem.compute(direct);
    });
  const auto seconds = perf::median_seconds(repeats, bodies);
  Outcome outcome{seconds[0], with_direct ? seconds[1] : 0.0, 0.0, {}};
  fmm.time_parts();
  if (with_direct) {
    problem.compute(direct);
    const auto exact = to_host(problem.velocity);
    problem.compute(fmm);
    outcome.error = relative_error(to_host(problem.velocity), exact);
  } else {
    outcome.error = fmm.measure_error(problem.sources(), problem.position, 300);
  }
  outcome.statistics = fmm.statistics();
  return outcome;
}

/// Error between the nearest well-separated boxes: sources fill one, targets the next but one along x.
double nearest_boxes_error(const FmmOptions& chosen, const double blob_over_half_width) {
  constexpr int n = 200;
  constexpr double half_width = 0.37;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-0.9999, 0.9999), strength(-1.0, 1.0);
  std::vector<Vec3> source, target, force;
  for (int i = 0; i < n; ++i) {
    source.push_back(half_width * Vec3{uniform(random), uniform(random), uniform(random)});
    target.push_back(half_width * Vec3{4.0 + uniform(random), uniform(random), uniform(random)});
    force.push_back({1.0 + strength(random), 0.5 + strength(random), strength(random) - 0.7});
  }
  // The corners pin the boxes.
  // Cells fit the nodes' extent, or come in steps where operators depend on them.
  const double pin = chosen.far_field == FarField::regularized ? 0.9999 : 1.0;
  source[0] = half_width * Vec3{-pin, -0.9999, -0.9999};
  target[0] = half_width * Vec3{4.0 + pin, 0.9999, 0.9999};
  const Sources sources{to_device("position", source), to_device("force", force),
                        to_device("blob", std::vector<double>(n, blob_over_half_width * half_width))};
  const Vectors at = to_device("target", target), got("got", n), exact("exact", n);
  FmmOptions options = chosen;
  options.tolerance = 1.0;
  options.leaf_size = 1;
  options.min_half_width = half_width;
  FmmMobility fmm(viscosity, options);
  fmm.add_velocity(sources, at, got);
  DirectMobility(viscosity, Precision::in_double).add_velocity(sources, at, exact);
  if (fmm.statistics().work.near_pairs > 0.0 || fmm.statistics().work.far_pairs < 1.0) return -1.0;
  return relative_error(to_host(got), to_host(exact));
}

void print_nearest_boxes(const char* name, const FmmOptions& chosen, const double ratio) {
  FmmOptions options = chosen;
  options.precision = Precision::in_double;
  std::printf("%s,%g,%d,%g,%.1e,%.1e\n", name, ratio, options.order, options.singular_cutoff,
              nearest_boxes_error(options, ratio), harmonic_floor(ratio, 1.0));
  std::fflush(stdout);
}

constexpr const char* nearest_boxes_header = "far_field,eps_over_h,p,cutoff,error,floor_law";

/// The surfaces of 16 points per edge of which double precision was once expected; minutes of set-up.
void bench_sixteen_points() {
  std::printf("\n# Nearest well-separated boxes, p = 14 and 16\n%s\n", nearest_boxes_header);
  for (const int p : {14, 16})
    for (const double ratio : {1e-4, 0.01, 0.04, 0.1, 0.2, 0.4})
      for (const double cutoff : {1e-15, 1e-10}) {
        if (p == 14 && cutoff > 1e-15) continue;
        FmmOptions options;
        options.far_field = FarField::stokeslet;
        options.order = p;
        options.singular_cutoff = cutoff;
        print_nearest_boxes("stokeslet", options, ratio);
      }
}

void bench_nearest_boxes(const bool tiny) {
  std::printf("\n# Nearest well-separated boxes\n%s\n", nearest_boxes_header);
  struct Field {
    const char* name;
    FarField field;
    bool stokes_part_only;
  };
  for (const Field field :
       {Field{"harmonic", FarField::harmonic, false}, Field{"stokeslet", FarField::stokeslet, false},
        Field{"stokeslet_doublet", FarField::stokeslet, true}, Field{"regularized", FarField::regularized, false}})
    for (const double ratio : {1e-4, 0.01, 0.04, 0.1, 0.2, 0.4})
      for (const int p : {4, 6, 8, 10, 12, 14, 16})
        for (const double cutoff : {1e-15, 1e-12, 1e-9, 1e-6}) {
          if (tiny && (p > 6 || cutoff > 1e-15)) continue;
          if (field.field != FarField::harmonic && p > 12) continue;
          FmmOptions options;
          options.far_field = field.field;
          options.stokes_part_only = field.stokes_part_only;
          options.order = p;
          options.singular_cutoff = cutoff;
          print_nearest_boxes(field.name, options, ratio);
        }
}

void print_outcome(const char* shape, const Case& problem, const double tolerance, const Outcome& outcome) {
  const FmmStatistics& s = outcome.statistics;
  std::printf("%s,%d,%g,%d,%s,%.4f,%.4f,%.1f,%.1e,%.3e,%.0f,%d,%.3g,%.0f,%.0f,%.2f,%.2f,%.2f,%.2f\n", shape, problem.n,
              tolerance, s.plan.order,
              s.plan.far_in_single ? s.plan.near_in_single ? "single" : "far_single" : "double", 1e3 * outcome.seconds,
              1e3 * outcome.direct_seconds, outcome.direct_seconds / outcome.seconds, outcome.error,
              problem.n / outcome.seconds, s.memory_bytes / problem.n, s.n_leaves, s.smallest_half_width,
              s.work.near_pairs / problem.n, s.work.far_pairs, 1e3 * s.tree_seconds, 1e3 * s.sort_seconds,
              1e3 * s.far_seconds, 1e3 * s.leaf_seconds);
  std::fflush(stdout);
}

constexpr const char* outcome_header =
    "shape,nodes,tolerance,p,precision,fmm_ms,direct_ms,ratio,error,points_per_second,bytes_per_node,leaves,half_width,"
    "near_per_node,far_pairs,tree_ms,sort_ms,far_ms,leaf_ms";

void bench_speed(const bool tiny) {
  std::printf("\n# Speed against error\n%s\n", outcome_header);
  const int n = tiny ? 3600 : 23634;
  for (const auto& [shape, nodes] : {std::pair{"straight", make_straight(n)}, std::pair{"spiral", make_spiral(n)}}) {
    Case problem(nodes, fiber_blob), fine(nodes, 2e-4);
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1.2e-6, 1e-6}) {
      FmmOptions options;
      options.tolerance = tolerance;
      print_outcome(shape, problem, tolerance, measure(problem, options, tiny ? 1 : 7, true));
    }
    for (const double tolerance : {1e-7, 1e-8, 1e-9}) {
      FmmOptions options;
      options.tolerance = tolerance;
      print_outcome((std::string(shape) + "_fine_blob").c_str(), fine, tolerance,
                    measure(fine, options, tiny ? 1 : 5, true));
    }
  }
}

/// Sums of a step that share a tree, beside sums that each make one, taking turns.
void bench_step(const bool tiny) {
  std::printf("\n# A tree for a step\nshape,nodes,tolerance,new_tree_ms,kept_tree_ms,ratio\n");
  const int n = tiny ? 3600 : 23634, n_uniform = tiny ? 2000 : 100000;
  for (const auto& [shape, nodes] : {std::pair{"straight", make_straight(n)}, std::pair{"spiral", make_spiral(n)},
                                     std::pair{"uniform", make_uniform(n_uniform)}}) {
    Case problem(nodes, shape[0] == 'u' ? 0.1 / std::cbrt(n_uniform) : fiber_blob);
    for (const double tolerance : {1e-4, 1e-5, 1e-6}) {
      FmmOptions options;
      options.tolerance = tolerance;
      FmmMobility anew(viscosity, options), kept(viscosity, options);
      kept.begin_step();
      const auto evaluate = [&problem](FmmMobility& fmm) {
        return [&] {
          problem.move_nodes();
          problem.compute(fmm);
        };
      };
      const std::vector<std::function<void()>> bodies = {evaluate(anew), evaluate(kept)};
      const auto seconds = perf::median_seconds(tiny ? 1 : 15, bodies);
      std::printf("%s,%d,%g,%.3f,%.3f,%.2f\n", shape, problem.n, tolerance, 1e3 * seconds[0], 1e3 * seconds[1],
                  seconds[0] / seconds[1]);
      std::fflush(stdout);
    }
  }
}

void bench_crossover() {
  std::printf("\n# Crossover at 1e-4\n%s\n", outcome_header);
  for (const int n : {720, 900, 1080, 1440, 2034, 2880, 4050, 5760})
    for (const auto& [shape, nodes] : {std::pair{"straight", make_straight(n)}, std::pair{"spiral", make_spiral(n)},
                                       std::pair{"uniform", make_uniform(n)}}) {
      Case problem(nodes, shape[0] == 'u' ? 0.1 / std::cbrt(n) : fiber_blob);
      print_outcome(shape, problem, 1e-4, measure(problem, {}, 21, true));
    }
}

/// @param only  this number of points; 0: all
void bench_uniform(const bool tiny, const int only) {
  std::printf("\n# Uniform cube\n%s\n", outcome_header);
  for (const double tolerance : {1e-4, 1e-6})
    for (const int n : {10000, 31623, 100000, 316228, 1000000}) {
      if ((tiny && n > 10000) || (only > 0 && n != only)) continue;
      Case problem(make_uniform(n), 0.1 / std::cbrt(n));
      FmmOptions options;
      options.tolerance = tolerance;
      print_outcome("uniform", problem, tolerance, measure(problem, options, n > 300000 ? 1 : 3, n <= 31623));
    }
}

/// Sums that each make a tree and sums that share one, by the path through the execution space's memory and, where
/// this is the host, by the host's beside it. @param leaves  by leaf sizes, too: what suits a host need not suit a
/// device
void bench_device(const bool tiny, const bool leaves, const int only) {
  std::printf("\n# Device path\npath,leaf_size,kept_tree_ms,%s\n", outcome_header);
  struct Shape {
    const char* name;
    std::vector<Vec3> nodes;
    double blob;
  };
  std::vector<Shape> shapes;
  for (const int n : {23634, 94536}) {
    shapes.push_back({"straight", make_straight(tiny ? 1440 : n), fiber_blob});
    shapes.push_back({"spiral", make_spiral(tiny ? 1440 : n), fiber_blob});
  }
  const int n_fibers = tiny ? 10 : 1000;
  shapes.push_back({"suspension", make_suspension(n_fibers, 20, 9), fiber_blob});
  for (const int n : {100000, 1000000}) {
    const int n_nodes = tiny ? 2000 : on_host<ExecSpace> ? n / 10 : n;
    shapes.push_back({"uniform", make_uniform(n_nodes), 0.1 / std::cbrt(n_nodes)});
  }
  for (const Shape& shape : shapes) {
    if (only > 0 && static_cast<std::size_t>(only) != shape.nodes.size()) continue;
    Case problem(shape.nodes, shape.blob);
    for (const double tolerance : {1e-4, 1e-6, 1e-9})
      for (const int leaf_size : {0, 64, 128, 256, 512})
        for (const KernelPath path : {KernelPath::device, KernelPath::host}) {
          if (path == KernelPath::host && !(on_host<ExecSpace> && leaf_size == 0)) continue;
          if (leaf_size > 0 && !leaves) continue;
          if (tiny && tolerance < 1e-4) continue;
          if (tolerance < 1e-6 && problem.n != 1000000) continue;
          FmmOptions options;
          options.path = path;
          options.tolerance = tolerance;
          options.leaf_size = leaf_size;
          const Outcome anew = measure(problem, options, tiny ? 1 : 5, false);
          FmmMobility kept(viscosity, options);
          kept.begin_step();
          const auto seconds = perf::median_seconds(tiny ? 1 : 5, std::vector<std::function<void()>>{[&] {
                                                      problem.move_nodes();
                                                      problem.compute(kept);
                                                    }});
          std::printf("%s,%d,%.4f,", path == KernelPath::host ? "host" : "device", leaf_size, 1e3 * seconds[0]);
          print_outcome(shape.name, problem, tolerance, anew);
        }
  }
}

/// From nothing to the first velocity, less a second evaluation: what a run pays once.
void bench_setup(const bool tiny) {
  std::printf("\n# Set-up, once per run\nshape,p,precision,operators_s\n");
  for (const auto& [shape, nodes] :
       {std::pair{"straight", make_straight(23634)}, std::pair{"uniform", make_uniform(50000)}})
    for (const int p : {6, 8, 10, 12}) {
      if (tiny && p > 6) continue;
      for (const bool in_single : {true, false}) {
        if (in_single && p > 9) continue;
        FmmOptions options;
        options.order = p;
        options.tolerance = 1.0;
        options.leaf_size = 60;
        options.min_half_width = 0.006;
        options.precision = in_single ? Precision::in_single : Precision::in_double;
        if (!in_single) options.singular_cutoff = 1e-15;
        FmmMobility fmm(viscosity, options);
        Case problem(nodes, 1e-4);
        problem.compute(fmm);
        std::printf("%s,%d,%s,%.3f\n", shape, p, in_single ? "single" : "double", fmm.statistics().operators_seconds);
        std::fflush(stdout);
      }
    }
}

}  // namespace

int main(int argc, char** argv) {
  const Runtime runtime;
  perf::print_context();
  const std::vector<std::string> parts(argv + 1, argv + argc);
  const auto asked = [&](const char* part) {
    const bool tiny_only = parts.size() == 1 && parts.front() == "tiny";
    return parts.empty() || tiny_only || std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  const bool tiny = std::find(parts.begin(), parts.end(), "tiny") != parts.end();
  if (asked("pair")) bench_nearest_boxes(tiny);
  if (std::find(parts.begin(), parts.end(), "sixteen") != parts.end()) bench_sixteen_points();
  if (asked("speed")) bench_speed(tiny);
  if (asked("step")) bench_step(tiny);
  if (asked("crossover") && !tiny) bench_crossover();
  int only = 0;
  for (const std::string& part : parts) std::sscanf(part.c_str(), "only=%d", &only);
  if (asked("uniform")) bench_uniform(tiny, only);
  if (asked("setup")) bench_setup(tiny);
  const auto has = [&](const char* part) { return std::find(parts.begin(), parts.end(), part) != parts.end(); };
  if (tiny || has("device")) bench_device(tiny, has("leaves"), only);
  return 0;
}
