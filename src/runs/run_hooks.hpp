#pragma once

#include <skein/physics/physics.hpp>
#include <skein/solvers/integrator.hpp>

#include <functional>
#include <memory>

namespace skein {

/// What a caller may put between the parts of a run before it begins; both may be empty.
struct RunHooks {
  /// Sees the physics before anything uses it, and may replace its parts. @param state  of the run, for its whole life
  std::function<void(Physics& physics, const State& state)> prepare;

  /// Puts a right-hand side in front of the run's own, or returns null. @param dynamics, state  outlive what it returns
  std::function<std::unique_ptr<RightHandSide>(RightHandSide& dynamics, const State& state)> decorate;
};

}  // namespace skein
