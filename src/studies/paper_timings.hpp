#pragma once

#include <filesystem>
#include <vector>

namespace skein {

/// Wall times of one sum over the nodes of a straight fiber, on this machine.
struct SumTiming {
  int n_nodes = 0;
  double direct_seconds = 0.0;  ///< in double precision
  double fmm_seconds = 0.0;     ///< tree and lists included
  double fmm_error = 0.0;       ///< relative, 2-norm over all velocities
};

/// The fast multipole method at tolerance 1e-4 beside the direct sum, from 720 nodes to the longest fiber of LaGrone,
/// Cortez, Yan, Fauci 2019; a few seconds.
std::vector<SumTiming> time_paper_sums();

/// Number of nodes from which on the fast multipole method is faster, between the sizes that were timed by a power law;
/// the smallest size where it always is, not a number where it never is.
double find_crossover(const std::vector<SumTiming>& timings);

/// @throws Error(io_error)
void write_timings_csv(const std::filesystem::path& path, const std::vector<SumTiming>& timings);

}  // namespace skein
