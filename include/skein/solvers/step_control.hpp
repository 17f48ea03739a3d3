#pragma once

#include <skein/core/number_visitor.hpp>

namespace skein {

/// Chooses the next step from estimated errors: 1 is just tolerable. Predictive controller of Watts and Gustafsson as
/// in Sommeijer, Shampine, Verwer, J. Comput. Appl. Math. 88, 315 (1998), for errors per unit time.
class StepControl {
 public:
  /// @param order  with which an error falls with the step: 2 for errors per unit time of a method of second order
  explicit StepControl(const double order = 2.0) : order_(order) {}

  static constexpr double safety = 0.8;
  static constexpr double max_growth = 5.0;
  static constexpr double max_cut = 0.1;

  /// The step after an accepted one. @param error  > = 0, <= 1
  double after_accepted(double dt, double error);

  /// The step to try after a rejected one. @param error  > 1, or not finite
  double after_rejected(double dt, double error);

  struct Memory {
    double last_dt = 0.0;  ///< of the last accepted step; 0 before the first
    double last_error = 0.0;
    bool just_rejected = false;
  };
  const Memory& memory() const { return memory_; }
  void restore(const Memory& memory) { memory_ = memory; }
  void visit_memory(NumberVisitor& visitor);

 private:
  double order_;
  Memory memory_;
};

}  // namespace skein
