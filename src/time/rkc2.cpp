#include <skein/time/rkc2.hpp>

#include <skein/core/error.hpp>

#include "kernels/combination.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace skein {
namespace {

constexpr double spectral_margin = 1.2;  // sections that ovalize blow up within 20 steps of an underestimate
constexpr int steps_between_refreshes = 25;
constexpr double refresh_accuracy = 0.02;
constexpr int first_iterations = 60;
constexpr int refresh_iterations = 12;
constexpr int max_stages = 1000;  // rounding errors of a step grow with their square
constexpr int max_rejections = 30;
constexpr double min_step_ratio = 1e-12;  // of the largest step allowed

Vectors make_vectors(const char* label, const int n_nodes) {
  return Vectors(std::string("skein::Rkc2::") + label, static_cast<std::size_t>(n_nodes));
}

}  // namespace

Rkc2::Rkc2(RightHandSide& rhs, const Rkc2Options& options, const int n_nodes)
    : rhs_(rhs),
      options_(options),
      power_iteration_(n_nodes, options.displacement, options.seed),
      kept_direction_(make_vectors("kept_direction", n_nodes)),
      start_(make_vectors("start", n_nodes)),
      start_velocity_(make_vectors("start_velocity", n_nodes)),
      end_(make_vectors("end", n_nodes)),
      end_velocity_(make_vectors("end_velocity", n_nodes)),
      stage_{make_vectors("stage", n_nodes), make_vectors("stage", n_nodes), make_vectors("stage", n_nodes)},
      stage_velocity_(make_vectors("stage_velocity", n_nodes)),
      error_(make_vectors("error", n_nodes)) {}

int Rkc2::stages_for(const double dt, const double spectral_radius) {
  return std::max(2, 1 + static_cast<int>(std::sqrt(1.0 + 1.54 * dt * spectral_radius)));
}

// Which node's velocity at end_ is not finite: added to the positions, nearly nothing of it.
std::string Rkc2::find_velocity_fault() {
  combine<ExecSpace>(ExecSpace(), error_, {1.0, end_}, {1e-300, end_velocity_});
  return rhs_.find_fault(error_);
}

void Rkc2::refresh_spectral_radius(const double time, const bool first, const std::string& fault) {
  const double estimate =
      power_iteration_.estimate(rhs_, time, end_, end_velocity_, refresh_accuracy * (first ? 0.1 : 1.0),
                                first ? first_iterations : refresh_iterations);
  if (!std::isfinite(estimate)) {
    const std::string what = fault.empty() ? find_velocity_fault() : fault;
    throw Error(ExitCode::numerical,
                fmt::format("t = {:.6g}: velocities are not finite{}{}", time, what.empty() ? "" : "; ", what));
  }
  spectral_radius_ = spectral_margin * estimate;
  steps_since_refresh_ = 0;
}

/// A step whose error estimate should be about the tolerance, from the change of velocity over a tiny Euler step.
double Rkc2::first_step(const double time) {
  if (options_.fixed_step > 0.0) return options_.fixed_step;
  const double probe = spectral_radius_ > 0.0 ? std::min(options_.max_step, 1.0 / spectral_radius_) : options_.max_step;
  combine<ExecSpace>(ExecSpace(), stage_[0], {1.0, end_}, {probe, end_velocity_});
  rhs_.compute_velocity(time + probe, stage_[0], stage_velocity_);
  combine<ExecSpace>(ExecSpace(), error_, {1.0, stage_velocity_}, {-1.0, end_velocity_});
  const double error = root_mean_square<ExecSpace>(ExecSpace(), error_) / (options_.tolerance * options_.length_scale);
  return std::min(options_.max_step, error > 0.01 ? 0.1 * probe / error : 10.0 * probe);
}

/// Errors are counted per unit time for long steps, per step below this time. The estimate of a short step is mostly
/// that of stiff modes, overestimated and in proportion to dt: divided by dt it would never fall, and the step would
/// collapse to 1 / spectral radius. The factor is measured: ten times less costs a tenth more evaluations and brings
/// rejections, without a smaller error (L = 0.139 orbit).
double Rkc2::shortest_accounting_time() const { return 7.5 * std::sqrt(options_.tolerance) * options_.time_scale; }

/// A fiber along the flow turns slowly, and what it is off by then grows with the square of its aspect ratio until it
/// flips: no local estimate sees that. The bound makes the error at the end fall with the tolerance (L = 0.139 orbit at
/// t = 6: 2.3e-4 L with steps up to 0.1, as the square of the bound).
double Rkc2::largest_step() const {
  return std::min(options_.max_step, 12.0 * std::sqrt(options_.tolerance) * options_.time_scale);
}

/// One step from start_ to end_ with the velocity there, both left in the members, and its error.
Rkc2::Attempt Rkc2::attempt(const double time, const double dt) {
  const int stages = stages_for(dt, spectral_radius_);
  const double s = stages;
  // Chebyshev polynomials T_j and their first two derivatives at w0, by their recurrence.
  const double w0 = 1.0 + 2.0 / (13.0 * s * s);
  const double root = std::sqrt(w0 * w0 - 1.0);
  const double argument = s * std::log(w0 + root);
  const double w1 = std::sinh(argument) * (w0 * w0 - 1.0) / (std::cosh(argument) * s * root - w0 * std::sinh(argument));

  double t_2 = 1.0, t_1 = w0, dt_2 = 0.0, dt_1 = 1.0, ddt_2 = 0.0, ddt_1 = 0.0;  // of j - 2 and j - 1
  double b_2 = 1.0 / (4.0 * w0 * w0), b_1 = b_2;
  double mu_tilde = w1 * b_1;
  double c_2 = 0.0, c_1 = mu_tilde;  // stage times over dt

  combine<ExecSpace>(ExecSpace(), stage_[1], {1.0, start_}, {mu_tilde * dt, start_velocity_});
  Vectors y_2 = start_, y_1 = stage_[1], y = stage_[2], spare = stage_[0];
  double a_1 = 1.0 - b_1 * t_1;
  for (int j = 2; j <= stages; ++j) {
    const double t = 2.0 * w0 * t_1 - t_2;
    const double d = 2.0 * w0 * dt_1 - dt_2 + 2.0 * t_1;
    const double dd = 2.0 * w0 * ddt_1 - ddt_2 + 4.0 * dt_1;
    const double b = dd / (d * d);
    const double mu = 2.0 * w0 * b / b_1;
    const double nu = -b / b_2;
    mu_tilde = mu * w1 / w0;
    const double gamma_tilde = -a_1 * mu_tilde;
    rhs_.compute_velocity(time + c_1 * dt, y_1, stage_velocity_);
    const Vectors& target = j == stages ? end_ : y;
    combine<ExecSpace>(ExecSpace(), target, {1.0 - mu - nu, start_}, {mu, y_1}, {nu, y_2},
                       {mu_tilde * dt, stage_velocity_}, {gamma_tilde * dt, start_velocity_});
    const double c = mu * c_1 + nu * c_2 + mu_tilde + gamma_tilde;
    // Rotate the three buffers; start_ is never written.
    const Vectors freed = j == 2 ? spare : y_2;
    y_2 = y_1;
    y_1 = target;
    y = freed;
    t_2 = t_1, t_1 = t;
    dt_2 = dt_1, dt_1 = d;
    ddt_2 = ddt_1, ddt_1 = dd;
    b_2 = b_1, b_1 = b;
    c_2 = c_1, c_1 = c;
    a_1 = 1.0 - b * t;
  }
  rhs_.compute_velocity(time + dt, end_, end_velocity_);
  combine<ExecSpace>(ExecSpace(), error_, {0.8, start_}, {-0.8, end_}, {0.4 * dt, start_velocity_},
                     {0.4 * dt, end_velocity_});
  return {root_mean_square<ExecSpace>(ExecSpace(), error_) /
              (options_.tolerance * options_.length_scale * std::max(dt, shortest_accounting_time())),
          stages};
}

void Rkc2::swap_ends() {
  std::swap(start_, end_);
  std::swap(start_velocity_, end_velocity_);
  in_step_ = !in_step_;
}

void Rkc2::keep_memory() {
  kept_ = {control_, spectral_radius_, next_dt_, steps_since_refresh_, started_};
  Kokkos::deep_copy(ExecSpace(), kept_direction_, power_iteration_.vector());
}

void Rkc2::bring_memory_back() {
  control_ = kept_.control;
  spectral_radius_ = kept_.spectral_radius;
  next_dt_ = kept_.next_dt;
  steps_since_refresh_ = kept_.steps_since_refresh;
  started_ = kept_.started;
  Kokkos::deep_copy(ExecSpace(), power_iteration_.vector(), kept_direction_);
  if (in_step_) swap_ends();
}

// Of the last step only its end: start_ serves frames inside that step, which are written before anything is saved.
void Rkc2::visit_memory(MemoryVisitor& visitor) {
  visitor.count("rkc2.started", started_);
  visitor.count("rkc2.steps_since_refresh", steps_since_refresh_);
  visitor.number("rkc2.spectral_radius", spectral_radius_);
  visitor.number("rkc2.next_dt", next_dt_);
  control_.visit_memory(visitor);
  power_iteration_.visit_memory(visitor);
  visitor.vectors("rkc2.end", end_);
  visitor.vectors("rkc2.end_velocity", end_velocity_);
}

StepReport Rkc2::advance(State& state, const double end) {
  keep_memory();
  try {
    return take_step(state, end);
  } catch (...) {
    bring_memory_back();
    throw;
  }
}

StepReport Rkc2::take_step(State& state, const double end) {
  if (!started_) {
    Kokkos::deep_copy(ExecSpace(), end_, state.position);
    rhs_.compute_velocity(state.time, end_, end_velocity_);
    refresh_spectral_radius(state.time, true);
    next_dt_ = first_step(state.time);
    started_ = true;
  } else if (steps_since_refresh_ >= steps_between_refreshes) {
    refresh_spectral_radius(state.time, false);
  }
  swap_ends();

  const double left = end - state.time;
  StepReport report;
  std::string fault;
  double dt = options_.fixed_step > 0.0 ? options_.fixed_step : std::min(next_dt_, largest_step());
  if (options_.fixed_step <= 0.0 && spectral_radius_ > 0.0)
    dt = std::min(dt, static_cast<double>(max_stages) * max_stages / (1.6 * spectral_radius_));
  for (;;) {
    const double planned = dt;
    // Two steps of equal size at the end rather than a large and a tiny one.
    if (planned >= left * (1.0 - 1e-10))
      dt = left;
    else if (options_.fixed_step <= 0.0 && planned > 0.5 * left)
      dt = 0.5 * left;
    const Attempt result = attempt(state.time, dt);
    report.stages = result.stages;
    report.error = result.error;
    fault = rhs_.find_fault(end_);
    if (fault.empty() && !std::isfinite(result.error)) fault = find_velocity_fault();
    // The velocity at the end belongs to the next step's memory: it has to be a number, too.
    if (fault.empty() && options_.fixed_step > 0.0 && std::isfinite(result.error)) break;
    if (fault.empty() && result.error <= 1.0) {
      const double proposed = control_.after_accepted(dt, result.error);
      // A step cut short by the end says little about the next one.
      next_dt_ = dt < planned ? std::max(proposed, planned) : proposed;
      break;
    }
    ++report.rejected;
    if (options_.fixed_step > 0.0 || report.rejected > max_rejections || dt < min_step_ratio * options_.max_step)
      throw Error(ExitCode::numerical,
                  fmt::format("no acceptable step at t = {:.6g} (step {}): {} attempts, the last with dt = {:.3g}, {} "
                              "stages and an error of {:.3g} times the tolerance{}{}",
                              state.time, state.step + 1, report.rejected, dt, result.stages, result.error,
                              fault.empty() ? "" : "; ", fault));
    dt = control_.after_rejected(dt, fault.empty() ? result.error : std::nan(""));
    // An underestimated radius shows as a rejection: look again, from the start of the step.
    swap_ends();
    refresh_spectral_radius(state.time, false, fault);
    swap_ends();
  }
  in_step_ = false;
  ++steps_since_refresh_;
  step_start_ = state.time;
  step_end_ = dt == left ? end : state.time + dt;
  state.time = step_end_;
  ++state.step;
  Kokkos::deep_copy(ExecSpace(), state.position, end_);
  report.dt = dt;
  report.spectral_radius = spectral_radius_;
  return report;
}

void Rkc2::interpolate(const double time, const Vectors& position) const {
  // Cubic Hermite polynomial: third order, as accurate as the step.
  const double dt = step_end_ - step_start_;
  const double theta = dt > 0.0 ? (time - step_start_) / dt : 1.0;
  const double h00 = (1.0 + 2.0 * theta) * (1.0 - theta) * (1.0 - theta), h10 = theta * (1.0 - theta) * (1.0 - theta);
  const double h01 = theta * theta * (3.0 - 2.0 * theta), h11 = theta * theta * (theta - 1.0);
  combine<ExecSpace>(ExecSpace(), position, {h00, start_}, {h10 * dt, start_velocity_}, {h01, end_},
                     {h11 * dt, end_velocity_});
}

std::string Rkc2::describe() const {
  if (options_.fixed_step > 0.0) return fmt::format("RKC2, fixed dt = {:g}", options_.fixed_step);
  return fmt::format("RKC2, error control at {:g} of the fiber's length per unit time", options_.tolerance);
}

}  // namespace skein
