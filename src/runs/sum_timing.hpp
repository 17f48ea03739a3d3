#pragma once

#include <skein/scene/scene_config.hpp>

#include <vector>

namespace skein {

/// Wall times of one sum over the nodes of a fiber, on this machine.
struct SumTiming {
  int n_nodes = 0;
  double direct_seconds = 0.0;  ///< in double precision
  double fmm_seconds = 0.0;     ///< tree and lists included
  double fmm_error = 0.0;       ///< relative, 2-norm over all velocities
};

/// Each fiber alone, summed directly and by the fast multipole method. Needs Kokkos.
/// @param tolerance  of the latter
std::vector<SumTiming> time_sums(const std::vector<FiberConfig>& fibers, double viscosity, double tolerance);

}  // namespace skein
