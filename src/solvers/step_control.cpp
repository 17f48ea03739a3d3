#include <skein/solvers/step_control.hpp>

#include <algorithm>
#include <cmath>

namespace skein {

namespace {

// error^(-1/order); the square root where it is one, for the last bit.
double factor_of(const double error, const double order) {
  return order == 2.0 ? 1.0 / std::sqrt(error) : std::pow(error, -1.0 / order);
}

}  // namespace

double StepControl::after_accepted(const double dt, const double error) {
  const double bounded = std::max(error, 1e-8);
  double factor = safety * factor_of(bounded, order_);
  if (memory_.last_dt > 0.0) {
    // If the error grew from step to step, expect it to grow again.
    const double predictive = factor * (dt / memory_.last_dt) / factor_of(memory_.last_error / bounded, order_);
    factor = std::min(factor, predictive);
  }
  factor = std::clamp(factor, max_cut, memory_.just_rejected ? 1.0 : max_growth);
  memory_ = {dt, bounded, false};
  return dt * factor;
}

double StepControl::after_rejected(const double dt, const double error) {
  memory_.just_rejected = true;
  if (!std::isfinite(error)) return dt * max_cut;
  return dt * std::clamp(safety * factor_of(error, order_), max_cut, 0.8);
}

void StepControl::visit_memory(NumberVisitor& visitor) {
  visitor.number("step_control.last_dt", memory_.last_dt);
  visitor.number("step_control.last_error", memory_.last_error);
  visitor.count("step_control.just_rejected", memory_.just_rejected);
}

}  // namespace skein
