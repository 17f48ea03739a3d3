#pragma once

#include <skein/solvers/control_options.hpp>
#include <skein/solvers/integrator.hpp>
#include <skein/solvers/step_control.hpp>

#include <string>

namespace skein {

/// One-step methods that estimate their error: what they share is here, the attempt of a step is theirs. A rejected
/// attempt leaves no trace but in the controller.
class ControlledIntegrator : public Integrator {
 public:
  /// Cubic Hermite polynomial of both ends' positions and velocities: third order.
  void interpolate(double time, const Vectors& position) const final;
  void visit_memory(MemoryVisitor& visitor) override;
  std::string describe() const override;

 protected:
  /// @param name   of the method, for the log and for the names in checkpoints
  /// @param order  with which the estimated error per unit time falls with the step
  /// @param vectors  what the method works with: those of the right-hand side, or whole ones
  ControlledIntegrator(RightHandSide& rhs, const ControlOptions& options, std::string name, double order, int n_nodes,
                       NodeVectors& vectors);

  struct Attempt {
    double error = 0.0;  ///< over tolerance; NaN where the step went wild
    int stages = 1;
    std::string failure;  ///< why there is no result; empty where there is one
    double excess = 1.0;  ///< by how much `error` is known to be too large, for what is reported
  };

  /// One step from start_ to end_ with the velocity there, both left in the members.
  virtual Attempt attempt(double time, double dt) = 0;

  /// Before the first attempt of a step, and again after each that was rejected.
  /// The latter is told why, where a node is to blame: the fault.
  virtual void prepare(double time, const ConstVectors& position, const ConstVectors& velocity) = 0;
  virtual void prepare_again(double time, const ConstVectors& position, const ConstVectors& velocity,
                             const std::string& fault) = 0;

  virtual double largest_step() const;
  virtual double spectral_radius() const { return 0.0; }
  virtual double probe_step() const;  ///< for the guess of the first step, time

  /// Velocities as they are in the step in work: at its end, where they are not smooth, those before.
  void compute_velocity(double time, const ConstVectors& position, const Vectors& velocity);
  double inside_piece(const double time) const { return time < latest_time_ ? time : latest_time_; }

  /// The root mean square of a local error over what is allowed in a step of dt.
  double measure_error(const ConstVectors& error, double dt) const;
  double allowed_error(double dt) const;

  Vectors make_vectors(const char* label) const;
  bool is_first_step() const { return !started_; }
  /// Which node's velocity at a position is not finite.
  std::string find_velocity_fault(const ConstVectors& position, const ConstVectors& velocity);

  ControlOptions options_;
  NodeVectors& vectors_;
  Vectors start_, start_velocity_;  ///< y_n and F_n of the step in work, or of the last accepted one
  Vectors end_, end_velocity_;      ///< y_(n+1) and F_(n+1)
  Vectors scratch_;                 ///< free before and after an attempt, and inside it

 private:
  StepReport take_step(State& state, double end) final;
  void swap_ends();
  double first_step(double time);
  double choose_step(double time) const;
  double shortest_accounting_time() const;
  [[noreturn]] void give_up(const State& state, const StepReport& report, double dt, const std::string& fault) const;

  std::string name_;
  int n_nodes_;
  StepControl control_;
  double next_dt_ = 0.0;
  bool started_ = false;
  double step_start_ = 0.0, step_end_ = 0.0;
  double latest_time_ = 0.0;  ///< of evaluations in the step in work
};

}  // namespace skein
