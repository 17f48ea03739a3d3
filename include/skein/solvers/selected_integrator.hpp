#pragma once

#include <skein/solvers/integrator.hpp>

#include <memory>
#include <string>
#include <utility>

namespace skein {

/// An integrator that was chosen, and says so.
class SelectedIntegrator final : public Integrator {
 public:
  SelectedIntegrator(RightHandSide& rhs, std::unique_ptr<Integrator> integrator, std::string reason)
      : Integrator(rhs), integrator_(std::move(integrator)), reason_(std::move(reason)) {}

  void interpolate(const double time, const Vectors& position) const override {
    integrator_->interpolate(time, position);
  }
  void visit_memory(MemoryVisitor& visitor) override { integrator_->visit_memory(visitor); }
  TimeMethod method() const override { return integrator_->method(); }
  ExpectedStep expect_step(const double spectral_radius) const override {
    return integrator_->expect_step(spectral_radius);
  }
  std::string describe() const override { return integrator_->describe() + "\n  chosen automatically: " + reason_; }

 private:
  StepReport take_step(State& state, const double end) override { return integrator_->advance(state, end); }

  std::unique_ptr<Integrator> integrator_;
  std::string reason_;
};

}  // namespace skein
