#pragma once

#include "runs/sum_timing.hpp"

#include <filesystem>
#include <vector>

namespace skein {

/// The fast multipole method at tolerance 1e-4 beside the direct sum, from 720 nodes to the longest fiber of LaGrone,
/// Cortez, Yan, Fauci 2019; a few seconds.
std::vector<SumTiming> time_paper_sums();

/// Number of nodes from which on the fast multipole method is faster, between the sizes that were timed by a power law;
/// the smallest size where it always is, not a number where it never is.
double find_crossover(const std::vector<SumTiming>& timings);

/// @throws Error(io_error)
void write_timings_csv(const std::filesystem::path& path, const std::vector<SumTiming>& timings);

}  // namespace skein
