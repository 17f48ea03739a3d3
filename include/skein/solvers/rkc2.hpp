#pragma once

#include <skein/solvers/controlled_integrator.hpp>
#include <skein/solvers/spectral_radius.hpp>

namespace skein {

/// What an RKC2 run may choose.
struct Rkc2Options : ControlOptions {
  double displacement = 1e-7;  ///< of a node in the power iteration, length
  std::uint64_t seed = 1;      ///< of the power iteration's first vector
};

/// Second-order Runge-Kutta-Chebyshev: an explicit method whose real stability interval grows with the square of its
/// stages, 0.653 s^2, for the real negative spectrum of springs in a viscous fluid.
/// Source: Sommeijer, Shampine, Verwer, J. Comput. Appl. Math. 88, 315 (1998).
class Rkc2 final : public ControlledIntegrator {
 public:
  Rkc2(RightHandSide& rhs, const Rkc2Options& options, int n_nodes);

  void visit_memory(MemoryVisitor& visitor) override;
  TimeMethod method() const override { return TimeMethod::rkc2; }
  ExpectedStep expect_step(double spectral_radius) const override;

 private:
  Attempt attempt(double time, double dt) override;
  void prepare(double time, const ConstVectors& position, const ConstVectors& velocity) override;
  void prepare_again(double time, const ConstVectors& position, const ConstVectors& velocity,
                     const std::string& fault) override;
  double largest_step() const override;
  double spectral_radius() const override { return spectral_radius_; }
  double probe_step() const override;
  void refresh_spectral_radius(double time, const ConstVectors& position, const ConstVectors& velocity,
                               const std::string& fault);

  SpectralRadius power_iteration_;
  double spectral_radius_ = 0.0;  ///< with its margin, 1 / time
  int steps_since_refresh_ = 0;

  Vectors stage_[3], stage_velocity_;
};

}  // namespace skein
