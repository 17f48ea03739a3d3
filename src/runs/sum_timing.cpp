#include "runs/sum_timing.hpp"

#include <skein/fibers/fiber.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include "runs/evaluation_time.hpp"

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

constexpr double any_viscosity = 1.0;
constexpr int n_checked = 300;

/// The nodes of one fiber, and forces of one size without a direction in common.
class FiberSum {
 public:
  explicit FiberSum(const FiberConfig& config) {
    const auto fiber = make_fibers({config});
    const auto nodes = make_surface_nodes(fiber);
    std::vector<Vec3> force;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto k = static_cast<double>(i);
      force.push_back({std::cos(1.3 * k), std::sin(2.1 * k), std::cos(0.7 * k)});
    }
    sources_ = {to_device("skein::FiberSum::position", nodes), to_device("skein::FiberSum::force", force),
                to_device("skein::FiberSum::blob", make_blobs(fiber))};
    velocity_ = Vectors("skein::FiberSum::velocity", nodes.size());
  }

  int n_nodes() const { return velocity_.extent_int(0); }
  const Sources& sources() const { return sources_; }
  /// Calls follow each other without a wait, as those of a run do, until they take long beside one.
  double time(Mobility& mobility) const {
    const double n_pairs = static_cast<double>(n_nodes()) * n_nodes();
    const int n_calls = on_host<ExecSpace> ? 1 : static_cast<int>(std::clamp(1e9 / n_pairs, 1.0, 50.0));
    const double seconds = time_calls([&] {
      for (int call = 0; call < n_calls; ++call) mobility.add_velocity(sources_, sources_.position, velocity_);
    });
    return seconds / n_calls;
  }

 private:
  Sources sources_;
  Vectors velocity_;
};

}  // namespace

DirectTiming time_direct(const FiberConfig& fiber, const Precision precision) {
  const FiberSum sum(fiber);
  DirectMobility mobility(any_viscosity, precision);
  return {sum.n_nodes(), precision, sum.time(mobility)};
}

double operations_per_pair(const Precision precision) { return precision == Precision::in_single ? 20.0 : 26.0; }

FmmTiming time_fmm(const FiberConfig& fiber, const double tolerance) {
  const FiberSum sum(fiber);
  FmmOptions options;
  options.tolerance = tolerance;
  FmmMobility mobility(any_viscosity, options);
  FmmTiming timing;
  timing.n_nodes = sum.n_nodes();
  timing.tolerance = tolerance;
  timing.seconds = sum.time(mobility);
  mobility.time_parts();
  timing.error = mobility.measure_error(sum.sources(), sum.sources().position, n_checked);
  const auto& parts = mobility.statistics();
  timing.tree = parts.tree_seconds;
  timing.sort = parts.sort_seconds;
  timing.far = parts.far_seconds;
  timing.leaves = parts.leaf_seconds;
  return timing;
}

std::vector<SumTiming> time_sums(const std::vector<FiberConfig>& fibers, const double tolerance) {
  std::vector<SumTiming> timings;
  for (const FiberConfig& fiber : fibers) {
    const DirectTiming direct = time_direct(fiber, Precision::in_double);
    const FmmTiming fmm = time_fmm(fiber, tolerance);
    timings.push_back({direct.n_nodes, direct.seconds, fmm.seconds, fmm.error});
  }
  return timings;
}

}  // namespace skein
