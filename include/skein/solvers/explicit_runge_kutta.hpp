#pragma once

#include <skein/solvers/controlled_integrator.hpp>

#include <vector>

namespace skein {

/// An explicit method whose step ends where its last velocity is taken, so that the next step has it for nothing.
struct RungeKuttaTableau {
  TimeMethod method;
  std::string name;
  double estimate_order;                    ///< with which the estimated error per unit time falls with the step
  std::vector<double> node;                 ///< [n_stages], stage times over dt; the first is 0
  std::vector<std::vector<double>> matrix;  ///< [n_stages] rows of stage weights; row 0 is empty
  std::vector<double> weight;               ///< [n_stages]
  std::vector<double> error;                ///< [n_stages + 1], of the error estimate; the last: velocity at the end
};

/// Third order, with an embedded second-order result. Source: Bogacki, Shampine, Appl. Math. Lett. 2, 321 (1989).
RungeKuttaTableau make_bogacki_shampine();

/// The classical method of fourth order. Its error estimate is the difference to the third-order result that takes the
/// velocity at the end instead of the last stage's: dt (k4 - F_(n+1)) / 6. It is blind to
/// what changes a velocity with time alone, wherever nodes are.
RungeKuttaTableau make_classical_runge_kutta();

/// Explicit references. Stiff springs bind their steps to about 2.5 over the spectral radius.
class ExplicitRungeKutta final : public ControlledIntegrator {
 public:
  ExplicitRungeKutta(RightHandSide& rhs, const ControlOptions& options, RungeKuttaTableau tableau, int n_nodes);

  TimeMethod method() const override { return tableau_.method; }
  ExpectedStep expect_step(double spectral_radius) const override;

 private:
  Attempt attempt(double time, double dt) override;
  void prepare(double, const ConstVectors&, const ConstVectors&) override {}
  void prepare_again(double, const ConstVectors&, const ConstVectors&, const std::string&) override {}

  /// target = start_ + dt sum of factor[i] stage velocity i.
  void add_stages(const Vectors& target, double dt, const std::vector<double>& factor);

  RungeKuttaTableau tableau_;
  std::vector<Vectors> stage_velocity_;  ///< of stages 1.., stage 0's is start_velocity_
};

}  // namespace skein
