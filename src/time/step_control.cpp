#include <skein/time/step_control.hpp>

#include <algorithm>
#include <cmath>

namespace skein {

double StepControl::after_accepted(const double dt, const double error) {
  const double bounded = std::max(error, 1e-8);
  double factor = safety / std::sqrt(bounded);
  if (memory_.last_dt > 0.0) {
    // If the error grew from step to step, expect it to grow again.
    const double predictive = factor * (dt / memory_.last_dt) * std::sqrt(memory_.last_error / bounded);
    factor = std::min(factor, predictive);
  }
  factor = std::clamp(factor, max_cut, memory_.just_rejected ? 1.0 : max_growth);
  memory_ = {dt, bounded, false};
  return dt * factor;
}

double StepControl::after_rejected(const double dt, const double error) {
  memory_.just_rejected = true;
  if (!std::isfinite(error)) return dt * max_cut;
  return dt * std::clamp(safety / std::sqrt(error), max_cut, 0.8);
}

void StepControl::visit_memory(MemoryVisitor& visitor) {
  visitor.number("step_control.last_dt", memory_.last_dt);
  visitor.number("step_control.last_error", memory_.last_error);
  visitor.count("step_control.just_rejected", memory_.just_rejected);
}

}  // namespace skein
