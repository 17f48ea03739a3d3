#pragma once

#include <skein/time/integrator.hpp>
#include <skein/time/spectral_radius.hpp>
#include <skein/time/step_control.hpp>

namespace skein {

/// What an RKC2 run may choose.
struct Rkc2Options {
  double tolerance = 1e-4;      ///< error per unit time over the length scale
  double length_scale = 1.0;    ///< length
  double time_scale = 1.0;      ///< of the flow, 1 / shear rate; time
  double fixed_step = 0.0;      ///< > 0 switches the error control off
  double max_step = 0.1;        ///< time
  double displacement = 1e-7;   ///< of a node in the power iteration, length
  std::uint64_t seed = 1;       ///< of the power iteration's first vector
};

/// Second-order Runge-Kutta-Chebyshev: an explicit method whose real stability interval grows with the square of its
/// stages, 0.653 s^2, for the real negative spectrum of springs in a viscous fluid.
/// Source: Sommeijer, Shampine, Verwer, J. Comput. Appl. Math. 88, 315 (1998).
class Rkc2 final : public Integrator {
 public:
  Rkc2(RightHandSide& rhs, const Rkc2Options& options, int n_nodes);

  StepReport advance(State& state, double end) override;
  void interpolate(double time, const Vectors& position) const override;
  void visit_memory(MemoryVisitor& visitor) override;
  std::string describe() const override;

  /// Stages for a stable step: 1 + int(sqrt(1 + 1.54 dt radius)), at least 2.
  static int stages_for(double dt, double spectral_radius);

 private:
  struct Attempt {
    double error;  ///< over tolerance; NaN where the step went wild
    int stages;
  };
  StepReport take_step(State& state, double end);
  Attempt attempt(double time, double dt);
  void swap_ends();
  void keep_memory();
  void bring_memory_back();
  void refresh_spectral_radius(double time, bool first, const std::string& fault = "");
  std::string find_velocity_fault();
  double first_step(double time);
  double shortest_accounting_time() const;
  double largest_step() const;

  RightHandSide& rhs_;
  Rkc2Options options_;
  SpectralRadius power_iteration_;
  StepControl control_;
  double spectral_radius_ = 0.0;      ///< with its margin, 1 / time
  double next_dt_ = 0.0;
  int steps_since_refresh_ = 0;
  bool started_ = false;

  struct Kept {
    StepControl control;
    double spectral_radius = 0.0, next_dt = 0.0;
    int steps_since_refresh = 0;
    bool started = false;
  };
  Kept kept_;               ///< memory at the start of the step, with kept_direction_
  Vectors kept_direction_;
  bool in_step_ = false;    ///< start_ holds the last accepted positions, not end_

  double step_start_ = 0.0, step_end_ = 0.0;
  Vectors start_, start_velocity_;    ///< y_n and F_n of the last accepted step
  Vectors end_, end_velocity_;        ///< y_(n+1) and F_(n+1)
  Vectors stage_[3], stage_velocity_, error_;
};

}  // namespace skein
