#pragma once

#include <skein/solvers/controlled_integrator.hpp>

#include <memory>
#include <string>

namespace skein {

/// Which method is expected to do with the least work, and why.
struct MethodSelection {
  TimeMethod method;
  std::string reason;  ///< one line with the numbers that decided
};

/// @param spectral_radius    1 / time
/// @param factorization      of the linearization's preconditioner, in evaluations, as the next
/// @param preconditioning    once; negative where there is no linearization
MethodSelection select_method(const ControlOptions& options, double spectral_radius, double factorization,
                              double preconditioning);

/// An integrator that was chosen, and says so.
class SelectedIntegrator final : public Integrator {
 public:
  SelectedIntegrator(RightHandSide& rhs, std::unique_ptr<Integrator> integrator, std::string reason);

  void interpolate(const double time, const Vectors& position) const override {
    integrator_->interpolate(time, position);
  }
  void visit_memory(MemoryVisitor& visitor) override { integrator_->visit_memory(visitor); }
  TimeMethod method() const override { return integrator_->method(); }
  std::string describe() const override;

 private:
  StepReport take_step(State& state, const double end) override { return integrator_->advance(state, end); }

  std::unique_ptr<Integrator> integrator_;
  std::string reason_;
};

}  // namespace skein
