#pragma once

#include <skein/solvers/right_hand_side_decorator.hpp>

#include "runs/run_control.hpp"

namespace skein {

/// A right-hand side that can be left in the middle of a step: evaluations may take seconds, and a step many of them.
class WatchedDynamics final : public RightHandSideDecorator {
 public:
  WatchedDynamics(RightHandSide& dynamics, RunControl& control) : RightHandSideDecorator(dynamics), control_(control) {}

  /// @throws Interruption
  void compute_velocity(const double time, const ConstVectors& position, const Vectors& velocity) override {
    control_.check_within_step();
    inner_.compute_velocity(time, position, velocity);
  }

 private:
  RunControl& control_;
};

}  // namespace skein
