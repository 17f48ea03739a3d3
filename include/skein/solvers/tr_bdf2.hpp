#pragma once

#include <skein/solvers/controlled_integrator.hpp>
#include <skein/solvers/gmres.hpp>

namespace skein {

/// TR-BDF2: the trapezoidal rule to t + gamma dt and the backward differentiation formula from there to t + dt, with
/// gamma = 2 - sqrt(2). Implicit, of second order, and it damps stiff modes completely. Both stages start from an
/// extrapolation so good that one linear system each is mostly all they need; its matrix is that of the extrapolated
/// positions. With a matrix of the step's start (Rosenbrock methods, W-methods), a fiber that turns by a fifth of a
/// radian in a step sees its stretched springs pull in directions that the matrix holds for soft, and flies apart.
/// Sources: Bank et al., IEEE Trans. Electron Devices 32, 1992 (1985); Hosea, Shampine, Appl. Numer. Math. 20, 21
/// (1996).
class TrBdf2 final : public ControlledIntegrator {
 public:
  /// @throws Error(internal) if the right-hand side offers no linearization
  TrBdf2(RightHandSide& rhs, const ControlOptions& options, int n_nodes);

  void visit_memory(MemoryVisitor& visitor) override;
  TimeMethod method() const override { return TimeMethod::trbdf2; }
  ExpectedStep expect_step(double spectral_radius) const override;
  std::string describe() const override;

 private:
  Attempt attempt(double time, double dt) override;
  void prepare(double time, const ConstVectors& position, const ConstVectors& velocity) override;
  void prepare_again(double, const ConstVectors&, const ConstVectors&, const std::string&) override {}
  double largest_step() const override;

  /// What the preconditioner was made of, and what it has cost since.
  struct Preconditioner {
    double scale = 0.0;              ///< of the matrix at which it was made, time; 0: there is none
    double least_iterations = -1.0;  ///< of a step since; below 0 before the first
    double excess = 0.0;             ///< iterations since, beyond the least in each step
    std::int64_t number = 0;         ///< of factorizations
  };
  void update_preconditioner(double scale);
  void factorize(double scale);

  double stage_tolerance(double dt) const;

  /// Solves z = constant + scale F(time, z), starting from z = end_, into end_; the stage's velocity from the equation
  /// itself, without the stiff noise of one more evaluation.
  /// @returns why there is no solution; empty where there is one
  std::string solve_stage(double time, double dt, const ConstVectors& constant, const Vectors& stage_velocity);

  Linearization& linearization_;
  Gmres gmres_;
  Preconditioner preconditioner_;
  Vectors factorized_position_;
  std::int64_t number_made_ = -1;          ///< of the factors in the linearization
  int iterations_ = 0, newton_steps_ = 0;  ///< of the attempt in work

  // The rate of change of the velocity over the last accepted step extrapolates the next. After an attempt it is in
  // next_acceleration_, whose step is not known to be accepted before the next begins.
  Vectors acceleration_, next_acceleration_;
  bool is_next_ready_ = false;
  Vectors middle_velocity_, constant_, correction_;
};

}  // namespace skein
