#pragma once

#include <skein/time/controlled_integrator.hpp>
#include <skein/time/gmres.hpp>

namespace skein {

/// Linearly implicit method of second order and two stages, ROS2 with gamma = 1 - 1/sqrt(2): the order holds for any
/// matrix in the place of the Jacobian (a W-method), and with the stiff part of the Jacobian it damps stiff modes
/// completely. A step costs two velocities and two systems, solved by GMRES to a tenth of the error allowed.
/// Source: Verwer, Spee, Blom, Hundsdorfer, SIAM J. Sci. Comput. 20, 1456 (1999).
class Rosenbrock final : public ControlledIntegrator {
 public:
  /// @throws Error(internal) if the right-hand side offers no linearization
  Rosenbrock(RightHandSide& rhs, const ControlOptions& options, int n_nodes);

  void visit_memory(MemoryVisitor& visitor) override;
  std::string describe() const override;

 private:
  Attempt attempt(double time, double dt) override;
  void prepare(double time, const ConstVectors& position, const ConstVectors& velocity) override;
  void prepare_again(double time, const ConstVectors& position, const ConstVectors& velocity,
                     const std::string& fault) override;
  void keep_memory() override { kept_ = preconditioner_; }
  void bring_memory_back() override;

  /// What the preconditioner was made of, and what it has cost since.
  struct Preconditioner {
    double scale = 0.0;       ///< gamma dt at which it was made, time; 0: there is none
    int least_iterations = 0; ///< of a step since
    double excess = 0.0;      ///< iterations since, beyond the least in a step each
    std::int64_t number = 0;  ///< of factorizations
  };
  void update_preconditioner(double scale);
  void factorize(double scale);
  /// @returns why the system has no solution; empty where it has one
  std::string solve(double dt, const ConstVectors& b, const Vectors& k);

  Linearization& linearization_;
  Gmres gmres_;
  Preconditioner preconditioner_, kept_;
  Vectors factorized_position_, kept_position_;
  std::int64_t number_made_ = -1;  ///< of the factors in the linearization
  int iterations_ = 0;             ///< of the step in work
  Vectors first_, second_;         ///< k1, k2
};

}  // namespace skein
