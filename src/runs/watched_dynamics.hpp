#pragma once

#include <skein/solvers/right_hand_side.hpp>

#include "runs/run_control.hpp"

namespace skein {

/// A right-hand side that can be left in the middle of a step: evaluations may take seconds, and a step many of them.
class WatchedDynamics final : public RightHandSide {
 public:
  WatchedDynamics(RightHandSide& dynamics, RunControl& control) : dynamics_(dynamics), control_(control) {}

  /// @throws Interruption
  void compute_velocity(const double time, const ConstVectors& position, const Vectors& velocity) override {
    control_.check_within_step();
    dynamics_.compute_velocity(time, position, velocity);
  }
  std::string find_fault(const ConstVectors& position) const override { return dynamics_.find_fault(position); }
  void project(const Vectors& position) override { dynamics_.project(position); }
  std::int64_t evaluations() const override { return dynamics_.evaluations(); }
  const TimeCourse& time_course() const override { return dynamics_.time_course(); }
  void visit_memory(MemoryVisitor& visitor) override { dynamics_.visit_memory(visitor); }
  Linearization* linearization() override { return dynamics_.linearization(); }

 private:
  RightHandSide& dynamics_;
  RunControl& control_;
};

}  // namespace skein
