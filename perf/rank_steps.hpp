#pragma once

#include <skein/physics/sum_team.hpp>
#include <skein/scene/scene_config.hpp>

#include <Kokkos_Core.hpp>

#include <chrono>

namespace skein::perf {

/// Seconds that a call takes, with all that it has launched.
template <class Function>
double time_call(const Function& function) {
  const auto start = std::chrono::steady_clock::now();
  function();
  Kokkos::fence();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Prints what an evaluation takes in steps, by parts, of which rank 0 knows the time: the fastest of some steps. Their
/// nodes are owned by ranks, or all rank 0's, in turns.
/// @param sections  of the one fiber  @param team  null: one process
void measure_steps(int sections, TimeMethod method, SumTeam* team, int repeats);

}  // namespace skein::perf
