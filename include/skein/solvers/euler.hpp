#pragma once

#include <skein/solvers/integrator.hpp>

namespace skein {

/// Forward Euler with a fixed step: the paper's method, and the reference for cost. Stable while the step times the
/// spectral radius is below 2.
class Euler final : public Integrator {
 public:
  /// @param dt  > 0, time
  Euler(RightHandSide& rhs, double dt, double length_scale, int n_nodes);

  void interpolate(double time, const Vectors& position) const override;
  void visit_memory(MemoryVisitor& visitor) override;
  TimeMethod method() const override { return TimeMethod::euler; }
  ExpectedStep expect_step(double /*spectral_radius*/) const override { return {dt_}; }
  std::string describe() const override;

 private:
  StepReport take_step(State& state, double end) override;
  std::string explain_instability(double radius) const;

  double dt_;
  double length_scale_;
  double spectral_radius_ = 0.0;  ///< at the start, 1 / time; 0 before the first step
  double step_start_ = 0.0;
  double step_end_ = 0.0;
  NodeVectors& vectors_;
  Vectors start_;  ///< positions at step_start_
  Vectors end_;    ///< positions at step_end_
  Vectors velocity_;
};

}  // namespace skein
