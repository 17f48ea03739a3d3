#pragma once

#include <skein/arrays/types.hpp>

#include <algorithm>
#include <chrono>
#include <vector>

namespace skein::perf {

/// Wall times of several bodies in seconds, the median of `repeats` each. The bodies take turns, so that a noisy
/// machine disturbs all of them alike and ratios hold. One warm-up each; the device is idle at every start and every
/// stop.
template <class Body>
std::vector<double> median_seconds(const int repeats, const std::vector<Body>& bodies) {
  std::vector<std::vector<double>> seconds(bodies.size());
  for (int repeat = -1; repeat < repeats; ++repeat)
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      Kokkos::fence();
      const auto start = std::chrono::steady_clock::now();
      bodies[b]();
      Kokkos::fence();
      if (repeat >= 0)
        seconds[b].push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
  std::vector<double> medians;
  for (auto& times : seconds) {
    std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
    medians.push_back(times[times.size() / 2]);
  }
  return medians;
}

/// "# key: value" lines: machine, commit, compiler, Kokkos, threads.
void print_context();

}  // namespace skein::perf
