// Sums that ranks share, by the wall time of rank 0, and what it takes of each rank. By itself, or under mpirun.
// Usage: [mpirun -n N] bench_ranks [direct] [fiber] [cube [only=N_NODES]] [run [trbdf2] [sections=N]] [repeats=N]
//        [mpirun -n N] bench_ranks parts [only=N_NODES] [repeats=N]
// `tiny` makes all of it small.
//
// `run` takes steps of RKC2, or of TR-BDF2, with the fiber of 23 634 nodes, for a table of its own: seconds an
// evaluation by part, of which the flow is that of one rank's nodes, and `alone` what rank 0 does for all nodes at the
// end of a step. Lines of `whole` are of steps whose nodes are all rank 0's, taken in turns with the others.
//
// `parts`, by itself: a cube of which each rank has its own nodes and a part of the tree, and no rank has all; a line
// of its own, with the bytes a node of all that the system gave to the rank with the most, and the sum of velocities.
//
// A line of each sum: ranks, threads, nodes, seconds (fastest and median), work and waiting of the busiest rank, bytes.

#include <skein/arrays/runtime.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>
#include <skein/physics/sum_team.hpp>

#include "harness.hpp"
#include "mpi/launch.hpp"
#include "node_arrangements.hpp"
#include "rank_parts.hpp"
#include "rank_steps.hpp"
#include "sum_problem.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace skein {
namespace {

constexpr double viscosity = 1.0;

struct Problem : perf::SumProblem {
  Problem(std::string title, const std::vector<Vec3>& nodes, const double blob_size)
      : SumProblem(nodes, blob_size), name(std::move(title)) {}

  std::string name;
};

/// Times sums outside of steps, each with a tree of its own; in steps trees serve several.
void measure(const Problem& problem, Mobility& mobility, SumTeam* team, const int repeats) {
  const Sources sources = problem.sources();
  const auto sum = [&] { mobility.add_velocity(sources, problem.position, problem.velocity); };
  sum();
  const std::vector<double> work_before = team != nullptr ? team->work_seconds() : std::vector<double>{0.0};
  const RankTraffic before = team != nullptr ? team->ranks().traffic() : RankTraffic{};
  const auto* fmm = dynamic_cast<const FmmMobility*>(&mobility);
  FmmStatistics statistics;  // of the fastest
  std::vector<double> seconds;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    seconds.push_back(perf::time_call(sum));
    if (fmm != nullptr && seconds.back() <= *std::min_element(seconds.begin(), seconds.end()))
      statistics = fmm->statistics();
  }
  const RankTraffic after = team != nullptr ? team->ranks().traffic() : RankTraffic{};
  const std::vector<double> work = team != nullptr ? team->work_seconds() : std::vector<double>{0.0};
  double busiest = 0.0;
  for (std::size_t r = 0; r < work.size(); ++r) busiest = std::max(busiest, (work[r] - work_before[r]) / repeats);
  std::sort(seconds.begin(), seconds.end());
  std::printf("%s,%d,%d,%d,%.5g,%.5g,%.5g,%.5g,%.4g,%.4g,%.4g,%.3g,%.4g,%.4g,%.4g,%.4g,%.4g,%d\n", problem.name.c_str(),
              team != nullptr ? team->ranks().size() : 0, HostSpace().concurrency(), problem.n, seconds.front(),
              seconds[seconds.size() / 2], busiest, (after.wait_seconds - before.wait_seconds) / repeats,
              (after.broadcast_bytes - before.broadcast_bytes) / repeats,
              (after.exchanged_bytes - before.exchanged_bytes) / repeats,
              (after.gathered_bytes - before.gathered_bytes) / repeats, (after.messages - before.messages) / repeats,
              statistics.tree_seconds, statistics.sort_seconds, statistics.far_seconds, statistics.leaf_seconds,
              statistics.memory_bytes / problem.n, statistics.n_boxes);
  std::fflush(stdout);
}

void measure_fmm(const Problem& problem, SumTeam* team, const int repeats) {
  FmmOptions options;
  options.tolerance = 1e-4;
  FmmMobility mobility(viscosity, options, team);
  measure(problem, mobility, team, repeats);
}

/// What was asked for.
struct Request {
  std::vector<std::string> words;
  bool has(const std::string& word) const { return std::find(words.begin(), words.end(), word) != words.end(); }
  int number(const std::string& name, const int otherwise) const {
    for (const std::string& word : words)
      if (word.rfind(name + "=", 0) == 0) return std::stoi(word.substr(name.size() + 1));
    return otherwise;
  }
  bool is_tiny() const { return has("tiny"); }
  int n_cube() const { return number("only", is_tiny() ? 2000 : 1000000); }
  int repeats(const int otherwise) const { return number("repeats", is_tiny() ? 1 : otherwise); }
};

void run(const Request& asked, SumTeam* team) {
  const bool tiny = asked.is_tiny();
  const int n_cube = asked.n_cube();
  perf::print_context();
  std::printf(
      "sum,ranks,threads,nodes,fastest_s,median_s,busiest_work_s,rank0_waits_s,broadcast_B,exchanged_B,gathered_B,"
      "messages,"
      "tree_s,sort_s,far_s,leaf_s,bytes_per_node,boxes\n");
  const int n_fiber = tiny ? 3600 : 23634;
  if (tiny || asked.has("direct")) {
    const Problem problem("direct", perf::make_straight(n_fiber), perf::fiber_blob);
    DirectMobility mobility(viscosity, Precision::in_double, KernelPath::automatic, team);
    measure(problem, mobility, team, asked.repeats(5));
  }
  if (tiny || asked.has("fiber")) {
    const Problem problem("fiber", perf::make_straight(n_fiber), perf::fiber_blob);
    measure_fmm(problem, team, asked.repeats(60));
  }
  if (tiny || asked.has("run"))
    perf::measure_steps(asked.number("sections", tiny ? 120 : 1313),
                        asked.has("trbdf2") ? TimeMethod::trbdf2 : TimeMethod::rkc2, team, asked.repeats(60));
  if (tiny || asked.has("cube")) {
    const Problem problem("cube", perf::make_uniform(n_cube), 0.1 / std::cbrt(n_cube));
    measure_fmm(problem, team, asked.repeats(std::clamp(4000000 / n_cube, 3, 40)));
  }
}

int run_on_ranks(const Request& asked) {
  Communicator* const ranks = join_ranks();
  const Runtime runtime;
  if (asked.has("parts")) {
    if (ranks == nullptr || ranks->rank() == 0)
      std::printf(
          "parts,ranks,threads,nodes,fastest_s,median_s,tree_s,sort_s,far_s,leaf_s,peak_bytes_per_node,"
          "method_bytes_per_node,boxes,velocities\n");
    perf::measure_parts(asked.n_cube(), ranks, asked.repeats(3));
    return 0;
  }
  if (ranks != nullptr && ranks->rank() > 0) return serve_sums(*ranks);
  if (ranks == nullptr) {
    run(asked, nullptr);
    return 0;
  }
  {
    SumTeam team(*ranks);
    run(asked, &team);
  }
  dismiss_ranks(*ranks, 0);
  return 0;
}

}  // namespace
}  // namespace skein

int main(int argc, char** argv) {
  return skein::leave_ranks(skein::run_on_ranks({std::vector<std::string>(argv + 1, argv + argc)}));
}
