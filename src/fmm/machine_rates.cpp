#include <skein/arrays/default_path.hpp>
#include <skein/fmm/machine_rates.hpp>

#include <limits>

namespace skein {
namespace {

/// Of direct sums in single precision: what they promise.
constexpr double single_sum_error = 1e-6;

/// Direct sums are double: that they are exact is what they are taken for.
constexpr MachineRates host_rates{
    .measured_on = "a core with AVX-512, by perf/bench_direct and perf/bench_fmm",
    .direct_pair = {0.77, 0.40},
    .symmetric_direct_pair = {0.63, 0.35},
    .direct_sum = 0.0,
    .near_pair = {0.75, 0.40},
    .symmetric_near_pair = {0.68, 0.35},
    .surface_pair = {0.85, 0.45},
    .product = {1.0 / 30.0, 1.0 / 60.0},
    .transfer_work = 0.4,
    .node = 40.0,
    .tree = 2e4,
    // Below this the fast multipole method gains less than a factor of two (bench_fmm crossover).
    .least_fmm_nodes = 1500.0,
    .least_leaf_size = 0,
    .least_single_gain = std::numeric_limits<double>::infinity(),
};

/// Every pair is met from both sides. Direct sums are those of a prototype of kernels/stokeslet_teams.cpp, the rest
/// fits straight and coiled tubes of 23 634 and 94 536 nodes and cubes of 1e5 and 1e6, at 1e-4, 1e-6 and 1e-9, to
/// within 1.7. Most of a tree's time is launches and waits, so that small trees do not pay: 60 000 nodes are where a
/// straight tube's direct sum in single takes 1.3 times as long as the fast multipole method.
constexpr MachineRates device_rates{
    .measured_on = "direct sums: NVIDIA H100 80GB, fast multipole method: NVIDIA H200, CUDA 13.0, 26 November 2026",
    .direct_pair = {0.00182, 0.00096},
    .symmetric_direct_pair = {0.00182, 0.00096},
    .direct_sum = 9e3,
    .near_pair = {0.0026, 0.0015},
    .symmetric_near_pair = {0.0026, 0.0015},
    .surface_pair = {0.015, 0.0077},
    .product = {3.2e-4, 1.6e-4},
    .transfer_work = 0.4,
    .node = 0.7,
    .tree = 2.4e6,
    .least_fmm_nodes = 60000.0,
    .least_leaf_size = 128,
    .least_single_gain = 1.3,
};

}  // namespace

const MachineRates& machine_rates(const KernelPath path) {
  return (path == KernelPath::automatic ? default_path() : path) == KernelPath::host ? host_rates : device_rates;
}

Precision choose_direct_precision(const MachineRates& rates, const double n_pairs, const double tolerance) {
  if (tolerance < single_sum_error) return Precision::in_double;
  const double in_double = rates.direct_sum + rates.direct_pair.in_double * n_pairs;
  const double in_single = rates.direct_sum + rates.direct_pair.in_single * n_pairs;
  return in_double >= rates.least_single_gain * in_single ? Precision::in_single : Precision::in_double;
}

}  // namespace skein
