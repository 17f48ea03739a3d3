#pragma once

#include <skein/physics/mobility.hpp>
#include <skein/solvers/right_hand_side.hpp>

#include "runs/run_hooks.hpp"

#include <memory>
#include <string>
#include <utility>

namespace skein {

/// For tests of runs: one component of one node's position, force or velocity is not a number in every evaluation of
/// one step.
struct FaultOrder {
  enum class Target { position, force, velocity };
  Target target = Target::position;
  std::int64_t step = 1;  ///< 1 is the first
};

/// Hooks that spoil what the order says.
RunHooks make_fault_hooks(const FaultOrder& order);

/// What SKEIN_TEST_NAN=<position|force|velocity>:<step> in the environment asks for; empty hooks without it.
RunHooks read_fault_hooks();

}  // namespace skein
