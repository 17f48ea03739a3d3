#include <skein/arrays/combination.hpp>
#include <skein/arrays/machine_peaks.hpp>
#include <skein/core/stopwatch.hpp>

#include <Kokkos_Graph.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein {
namespace {

/// Chains of fused operations that hide each other's latency: eight vectors of 64 bytes of a host, 16 numbers of a
/// thread on a device.
template <class Real, class Space>
constexpr int n_chains = on_host<Space> ? 512 / static_cast<int>(sizeof(Real)) : 16;
constexpr int operations_per_chain = 4096;

template <class Real, class Space>
struct FusedChains {
  ScalarView<Space> result;

  KOKKOS_INLINE_FUNCTION void operator()(const int i) const {
    constexpr int n = n_chains<Real, Space>;
    const Real factor = Real(1) - Real(1e-6) * Real(i % 7);
    Real x[n];
    for (int k = 0; k < n; ++k) x[k] = Real(k);
    for (int step = 0; step < operations_per_chain; ++step)
      for (int k = 0; k < n; ++k) x[k] = std::fma(x[k], factor, Real(1e-3));
    Real sum = 0;
    for (int k = 0; k < n; ++k) sum += x[k];
    result(i) = static_cast<double>(sum);  // read by nobody, but by the compiler
  }
};

struct AddOne {
  Scalars number;
  KOKKOS_INLINE_FUNCTION void operator()(const int i) const { number(i) += 1.0; }
};

/// A chain of small kernels, each after the one before.
auto make_chain(const ExecSpace& space, const int n_kernels, const AddOne& kernel) {
  namespace graphs = Kokkos::Experimental;
  return graphs::create_graph(space, [&](const auto& root) {
    graphs::GraphNodeRef<ExecSpace> last = root;
    for (int i = 0; i < n_kernels; ++i)
      last = last.then_parallel_for("skein::machine_peaks::link", Kokkos::RangePolicy<ExecSpace>(0, 1), kernel);
  });
}

/// The shortest of several calls, whose end is waited for, seconds.
template <class Call>
double time_best(const Call& call) {
  double best = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < 5; ++repeat) {
    Kokkos::fence();
    const auto start = WallClock::now();
    call();
    Kokkos::fence();
    best = std::min(best, seconds_since(start));
  }
  return best;
}

template <class Real>
double measure_operations(const ExecSpace& space) {
  const int n_items = (on_host<ExecSpace> ? 16 : 4) * space.concurrency();
  const FusedChains<Real, ExecSpace> chains{Scalars("skein::measure_operations", n_items)};
  const double seconds = time_best([&] {
    Kokkos::parallel_for("skein::measure_operations", Kokkos::RangePolicy<ExecSpace>(space, 0, n_items), chains);
  });
  return static_cast<double>(n_items) * n_chains<Real, ExecSpace> * operations_per_chain / seconds;
}

}  // namespace

MachinePeaks measure_machine_peaks() {
  const ExecSpace space;
  MachinePeaks peaks;
  peaks.double_operations = measure_operations<double>(space);
  peaks.single_operations = measure_operations<float>(space);

  constexpr int n_long = 4'000'000, n_launches = 1000;
  const Vectors a("skein::machine_peaks::a", n_long), b("skein::machine_peaks::b", n_long),
      sum("skein::machine_peaks::sum", n_long);
  const auto add = [&](const Vectors& result, const Vectors& one, const Vectors& other) {
    combine<ExecSpace>(space, result, {1.0, one}, {1.0, other});
  };
  peaks.bandwidth = 9.0 * sizeof(double) * n_long / time_best([&] { add(sum, a, b); });

  const Vectors small("skein::machine_peaks::small", 1);
  peaks.launch = time_best([&] {
                   for (int i = 0; i < n_launches; ++i) add(small, small, small);
                 }) /
                 n_launches;
  constexpr int n_chained = 100;
  const auto chain = make_chain(space, n_chained, AddOne{Scalars("skein::machine_peaks::number", 1)});
  chain.submit();  // the first time, it is prepared
  peaks.graph = time_best([&] {
                  for (int i = 0; i < n_launches; i += n_chained) chain.submit();
                }) /
                n_launches;
  peaks.wait = time_best([&] {
                 for (int i = 0; i < n_launches; ++i) {
                   add(small, small, small);
                   space.fence();
                 }
               }) /
               n_launches;
  return peaks;
}

}  // namespace skein
