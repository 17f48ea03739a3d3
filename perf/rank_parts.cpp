#include "rank_parts.hpp"

#include <skein/arrays/types.hpp>
#include <skein/core/counter_random.hpp>
#include <skein/fmm/fmm_sum.hpp>

#include "rank_steps.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace skein::perf {
namespace {

/// The most memory that the system has given to this process so far.
double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// Some of all nodes, and forces on them: the same for any number of ranks.
struct OwnNodes {
  Vectors position, force, velocity;
  Scalars blob;

  OwnNodes(const std::size_t first, const std::size_t n, const double blob_size)
      : position("position", n), force("force", n), velocity("velocity", n), blob("blob", n) {
    const auto x = Kokkos::create_mirror_view(position), f = Kokkos::create_mirror_view(force);
    const CounterRandom random(1, CounterRandom::Purpose::placement, 0);
    for (std::size_t i = 0; i < n; ++i) {
      const auto one = random.draw(3 * (first + i)), two = random.draw(3 * (first + i) + 1),
                 three = random.draw(3 * (first + i) + 2);
      store(x, static_cast<int>(i), Vec3{one[0], one[1], two[0]});
      store(f, static_cast<int>(i), Vec3{two[1] - 0.5, three[0] - 0.5, three[1] - 0.5});
    }
    Kokkos::deep_copy(position, x);
    Kokkos::deep_copy(force, f);
    Kokkos::deep_copy(blob, blob_size);
  }
  Sources sources() const { return {position, force, blob}; }
};

}  // namespace

void measure_parts(const int n_nodes, Communicator* ranks, const int repeats) {
  LoneProcess alone;
  Communicator& all = ranks != nullptr ? *ranks : alone;
  const RankParts parts = RankParts::evenly(static_cast<std::size_t>(n_nodes), all.size());
  const auto rank = static_cast<std::size_t>(all.rank());
  const double before = peak_bytes();
  const OwnNodes own(parts.first[rank], parts.count[rank], 0.1 / std::cbrt(n_nodes));
  FmmOptions options;
  options.tolerance = 1e-4;
  const auto sum = make_fmm_sum(KernelPath::host, ranks);
  sum->owners = ranks != nullptr ? parts : RankParts();
  std::vector<double> seconds;
  for (int repeat = 0; repeat < repeats; ++repeat)
    seconds.push_back(time_call([&] {
      if (ranks != nullptr)
        sum->take_part(own.sources(), parts);
      else
        sum->take(own.sources(), own.position);
      sum->compute(options, choose_fmm_plan(options, sum->largest_blob(), 0), 1.0);
      Kokkos::deep_copy(own.velocity, 0.0);
      sum->add_to(own.velocity);
    }));
  double check = 0.0;
  for (const Vec3 u : to_host(ConstVectors(own.velocity))) check += std::fabs(u.x) + std::fabs(u.y) + std::fabs(u.z);
  const std::vector<double> told = list_from_all(all, {peak_bytes() - before, sum->statistics.memory_bytes, check});
  if (all.rank() != 0) return;
  double most = 0.0, most_counted = 0.0, total = 0.0;
  for (std::size_t i = 0; i < told.size(); i += 3) {
    most = std::max(most, told[i]);
    most_counted = std::max(most_counted, told[i + 1]);
    total += told[i + 2];
  }
  std::sort(seconds.begin(), seconds.end());
  const FmmStatistics& last = sum->statistics;
  std::printf("parts,%d,%d,%d,%.5g,%.5g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%d,%.12g\n", ranks != nullptr ? all.size() : 0,
              HostSpace().concurrency(), n_nodes, seconds.front(), seconds[seconds.size() / 2], last.tree_seconds,
              last.sort_seconds, last.far_seconds, last.leaf_seconds, most / n_nodes, most_counted / n_nodes,
              last.n_boxes, total);
  std::fflush(stdout);
}

}  // namespace skein::perf
