#include <skein/core/error.hpp>
#include <skein/solvers/euler.hpp>
#include <skein/solvers/spectral_radius.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace skein {
namespace {

constexpr double displacement_ratio = 1e-7;  // of the length: small against node spacings, large against rounding

}  // namespace

Euler::Euler(RightHandSide& rhs, const double dt, const double length_scale, const int n_nodes)
    : Integrator(rhs),
      dt_(dt),
      length_scale_(length_scale),
      vectors_(rhs.vectors()),
      start_(vectors_.make("skein::Euler::start", n_nodes)),
      end_(vectors_.make("skein::Euler::end", n_nodes)),
      velocity_(vectors_.make("skein::Euler::velocity", n_nodes)) {
  SKEIN_REQUIRE(dt > 0.0, "Euler needs a step");
}

StepReport Euler::take_step(State& state, const double end) {
  // A last step shorter than a thousandth would be rounding: it is joined to the one before.
  const double left = end - state.time;
  const double allowed = std::min(dt_, rhs_.time_course().longest_step(state.time));
  const double dt = left < 1.001 * allowed ? left : allowed;
  vectors_.scatter(state.position, start_);
  rhs_.compute_velocity(state.time, start_, velocity_);
  double radius = spectral_radius_;
  if (radius == 0.0) {
    // Once, at the start: near a blow-up nodes are too far out for it to mean anything.
    SpectralRadius power_iteration(state.position.extent_int(0), displacement_ratio * length_scale_, 1, vectors_);
    radius = power_iteration.estimate(rhs_, state.time, start_, velocity_, 1e-3, 100);
  }
  vectors_.combine(end_, {{1.0, start_}, {dt, velocity_}});
  const std::string fault = rhs_.find_fault(end_);
  if (!fault.empty())
    throw Error(ExitCode::numerical, fmt::format("blow-up in step {} at t = {:.6g}: {}.\n{}", state.step + 1,
                                                 state.time + dt, fault, explain_instability(radius)));
  rhs_.project(end_);
  const Vectors end_of_all = vectors_.gather(end_);
  spectral_radius_ = radius;
  step_start_ = state.time;
  step_end_ = dt == left ? end : state.time + dt;
  Kokkos::deep_copy(ExecSpace(), state.position, end_of_all);
  state.time = step_end_;
  ++state.step;
  StepReport report;
  report.dt = dt;
  report.spectral_radius = spectral_radius_;
  return report;
}

std::string Euler::explain_instability(const double radius) const {
  return fmt::format(
      "Forward Euler is stable below dt = 2 / spectral radius = {:.3g} only (spectral radius {:.4g} at the start of "
      "the "
      "run); dt = {:.4g} gives dt * radius = {:.3g}. Set time.step below that, or use time.method = \"rkc2\".",
      2.0 / radius, radius, dt_, dt_ * radius);
}

void Euler::interpolate(const double time, const Vectors& position) const {
  const double theta = step_end_ > step_start_ ? (time - step_start_) / (step_end_ - step_start_) : 1.0;
  // Free between steps.
  vectors_.combine(velocity_, {{1.0 - theta, start_}, {theta, end_}});
  Kokkos::deep_copy(ExecSpace(), position, vectors_.gather(velocity_));
  rhs_.project(position);
}

void Euler::visit_memory(MemoryVisitor& visitor) { visitor.number("euler.spectral_radius", spectral_radius_); }

std::string Euler::describe() const { return fmt::format("forward Euler, dt = {:g}", dt_); }

}  // namespace skein
