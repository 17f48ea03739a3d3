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

/// Every pair is met from both sides. Rates fit straight and coiled tubes of 23 634 and 94 536 nodes and cubes of 1e5
/// and 1e6, at 1e-4, 1e-6 and 1e-9, to within 1.4. A tree is taken to serve ten sums of a step. 20 000 nodes are where
/// the direct sum in single takes as long as the fast multipole method: longer than for a straight tube, less than for
/// a coil.
constexpr MachineRates device_rates{
    .measured_on = "NVIDIA H100 80GB, CUDA 13.0, 27 November 2026, by bench_direct and bench_fmm device",
    .direct_pair = {0.00182, 0.00093},
    .symmetric_direct_pair = {0.00182, 0.00093},
    .direct_sum = 9e3,
    .near_pair = {0.0024, 0.00113},
    .symmetric_near_pair = {0.0024, 0.00113},
    .surface_pair = {0.006, 0.0026},
    .product = {1.6e-4, 9e-5},
    .transfer_work = 0.4,
    .node = 0.2,
    .tree = 3e5,
    .least_fmm_nodes = 20000.0,
    .least_leaf_size = 128,
    .least_single_gain = 1.3,
};

}  // namespace

const MachineRates& machine_rates(const KernelPath path) {
  return (path == KernelPath::automatic ? default_path() : path) == KernelPath::host ? host_rates : device_rates;
}

Precision choose_direct_precision(const MachineRates& rates, const double n_pairs, const double tolerance) {
  if (tolerance < single_sum_error) return Precision::in_double;
  const double in_double = rates.direct_nanoseconds(false, false, n_pairs);
  const double in_single = rates.direct_nanoseconds(false, true, n_pairs);
  return in_double >= rates.least_single_gain * in_single ? Precision::in_single : Precision::in_double;
}

}  // namespace skein
