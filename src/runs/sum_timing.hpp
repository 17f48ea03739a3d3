#pragma once

#include <skein/core/precision.hpp>
#include <skein/scene/scene_config.hpp>

#include <vector>

// Wall times of one sum over the nodes of a fiber, on this machine, seconds. All of it needs Kokkos.

namespace skein {

struct DirectTiming {
  int n_nodes = 0;
  Precision precision = Precision::in_double;
  double seconds = 0.0;

  double pairs_per_second() const { return static_cast<double>(n_nodes) * n_nodes / seconds; }
};
DirectTiming time_direct(const FiberConfig& fiber, Precision precision);

/// Operations of one pair of a direct sum, those of the reciprocal root included: a machine's peak over them is what no
/// sum exceeds, but that of a host, which meets pairs once for both of their nodes.
double operations_per_pair(Precision precision);

struct FmmTiming {
  int n_nodes = 0;
  double tolerance = 0.0;
  double error = 0.0;    ///< relative, 2-norm over 300 velocities
  double seconds = 0.0;  ///< all that follow, of a later call
  double tree = 0.0, sort = 0.0, far = 0.0, leaves = 0.0;
};
FmmTiming time_fmm(const FiberConfig& fiber, double tolerance);

/// Both side by side.
struct SumTiming {
  int n_nodes = 0;
  double direct_seconds = 0.0;  ///< in double precision
  double fmm_seconds = 0.0;     ///< tree and lists included
  double fmm_error = 0.0;
};

/// Each fiber alone, summed directly and by the fast multipole method. @param tolerance  of the latter
std::vector<SumTiming> time_sums(const std::vector<FiberConfig>& fibers, double tolerance);

}  // namespace skein
