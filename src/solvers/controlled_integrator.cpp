#include <skein/core/error.hpp>
#include <skein/solvers/controlled_integrator.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace skein {
namespace {

constexpr int max_rejections = 30;
constexpr double min_step_ratio = 1e-12;  // of the largest step allowed
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

ControlledIntegrator::ControlledIntegrator(RightHandSide& rhs, const ControlOptions& options, std::string name,
                                           const double order, const int n_nodes, NodeVectors& vectors)
    : Integrator(rhs),
      options_(options),
      vectors_(vectors),
      name_(std::move(name)),
      n_nodes_(n_nodes),
      control_(order) {
  start_ = make_vectors("start");
  start_velocity_ = make_vectors("start_velocity");
  end_ = make_vectors("end");
  end_velocity_ = make_vectors("end_velocity");
  scratch_ = make_vectors("scratch");
}

Vectors ControlledIntegrator::make_vectors(const char* label) const {
  return vectors_.make("skein::" + name_ + "::" + label, n_nodes_);
}

std::string ControlledIntegrator::find_velocity_fault(const ConstVectors& position, const ConstVectors& velocity) {
  // Added to the positions, nearly nothing of it, but what is not finite.
  vectors_.combine(scratch_, {{1.0, position}, {1e-300, velocity}});
  return rhs_.find_fault(scratch_);
}

/// Errors are counted per unit time for long steps, per step below this time. The estimate of a short step is mostly
/// that of stiff modes, overestimated and in proportion to dt: divided by dt it would never fall, and the step would
/// collapse to 1 / spectral radius. The factor is measured: ten times less costs a tenth more evaluations and brings
/// rejections, without a smaller error (L = 0.139 orbit).
double ControlledIntegrator::shortest_accounting_time() const {
  return 7.5 * options_.tolerance_root() * options_.time_scale;
}

double ControlledIntegrator::largest_step() const { return largest_controlled_step(options_); }

double ControlledIntegrator::allowed_error(const double dt) const {
  return options_.tolerance * options_.length_scale * std::max(dt, shortest_accounting_time());
}

/// The end of the step is complete: whether it has a fault is found out while the error is waited for.
double ControlledIntegrator::measure_error(const ConstVectors& error, const double dt) const {
  rhs_.seek_fault(end_);
  return vectors_.root_mean_square(error) / allowed_error(dt);
}

double ControlledIntegrator::probe_step() const { return std::min(options_.max_step, 1e-4 * options_.time_scale); }

/// A step whose error estimate should be about the tolerance, from the change of velocity over a tiny Euler step.
double ControlledIntegrator::first_step(const double time) {
  if (options_.fixed_step > 0.0) return options_.fixed_step;
  const double probe = probe_step();
  // start_ and its velocity are free before the first step.
  vectors_.combine(start_, {{1.0, end_}, {probe, end_velocity_}});
  compute_velocity(time + probe, start_, start_velocity_);
  vectors_.combine(scratch_, {{1.0, start_velocity_}, {-1.0, end_velocity_}});
  const double error = vectors_.root_mean_square(scratch_) / (options_.tolerance * options_.length_scale);
  return std::min(options_.max_step, error > 0.01 ? 0.1 * probe / error : 10.0 * probe);
}

void ControlledIntegrator::swap_ends() {
  std::swap(start_, end_);
  std::swap(start_velocity_, end_velocity_);
}

// Of the last step only its end: start_ serves frames inside that step, which are written before anything is saved.
void ControlledIntegrator::visit_memory(MemoryVisitor& visitor) {
  visitor.count(name_ + ".started", started_);
  visitor.number(name_ + ".next_dt", next_dt_);
  control_.visit_memory(visitor);
  visitor.node_vectors(name_ + ".end", vectors_, end_);
  visitor.node_vectors(name_ + ".end_velocity", vectors_, end_velocity_);
}

double ControlledIntegrator::choose_step(const double time) const {
  const double dt = options_.fixed_step > 0.0 ? options_.fixed_step : std::min(next_dt_, largest_step());
  return std::min(dt, rhs_.time_course().longest_step(time));
}

void ControlledIntegrator::compute_velocity(const double time, const ConstVectors& position, const Vectors& velocity) {
  rhs_.compute_velocity(inside_piece(time), position, velocity);
}

void ControlledIntegrator::give_up(const State& state, const StepReport& report, const double dt,
                                   const std::string& fault) const {
  throw Error(
      ExitCode::numerical,
      fmt::format("no acceptable step at t = {:.6g} (step {}): {} attempts, the last with dt = {:.3g}, {} stages "
                  "and an error of {:.3g} times the tolerance{}{}",
                  state.time, state.step + 1, report.rejected, dt, report.stages, report.error,
                  fault.empty() ? "" : "; ", fault));
}

StepReport ControlledIntegrator::take_step(State& state, const double end) {
  const TimeCourse& course = rhs_.time_course();
  latest_time_ = std::nextafter(course.next_break(state.time), -infinity);
  // The last step ended with the velocity before a break.
  if (!started_ || course.is_break(state.time)) {
    vectors_.scatter(state.position, end_);
    compute_velocity(state.time, end_, end_velocity_);
    const std::string fault = find_velocity_fault(end_, end_velocity_);
    if (!fault.empty())
      throw Error(ExitCode::numerical, fmt::format("t = {:.6g}: velocities are not finite; {}", state.time, fault));
  }
  prepare(state.time, end_, end_velocity_);
  if (!started_) next_dt_ = first_step(state.time);
  started_ = true;
  swap_ends();

  const double left = end - state.time;
  StepReport report;
  double dt = choose_step(state.time);
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
    report.local_error = result.error / result.excess * allowed_error(dt);
    std::string fault;
    if (!result.failure.empty()) {
      if (!std::isfinite(result.error)) fault = find_velocity_fault(end_, end_velocity_);
    } else {
      fault = rhs_.find_fault(end_);
      if (fault.empty() && !std::isfinite(result.error)) fault = find_velocity_fault(end_, end_velocity_);
      // The velocity at the end belongs to the next step's memory: it has to be a number, too.
      if (fault.empty() && options_.fixed_step > 0.0 && std::isfinite(result.error)) break;
      if (fault.empty() && result.error <= 1.0) {
        const double proposed = control_.after_accepted(dt, result.error);
        // A step cut short by the end says little about the next one.
        next_dt_ = dt < planned ? std::max(proposed, planned) : proposed;
        break;
      }
    }
    ++report.rejected;
    report.rejection = fmt::format("dt = {:.3g}: {}", dt,
                                   !result.failure.empty() ? result.failure
                                   : !fault.empty()        ? fault
                                                    : fmt::format("error {:.3g} times the tolerance", result.error));
    const std::string reason = result.failure + (result.failure.empty() || fault.empty() ? "" : "; ") + fault;
    if (options_.fixed_step > 0.0 || report.rejected > max_rejections || dt < min_step_ratio * largest_step())
      give_up(state, report, dt, reason);
    // Equations that were not solved are no blow-up: a cut to less than half does.
    dt = control_.after_rejected(dt, reason.empty() ? result.error : fault.empty() ? 4.0 : std::nan(""));
    prepare_again(state.time, start_, start_velocity_, fault);
  }
  rhs_.project(end_);
  gather_memory();
  step_start_ = state.time;
  step_end_ = dt == left ? end : state.time + dt;
  state.time = step_end_;
  ++state.step;
  Kokkos::deep_copy(ExecSpace(), state.position, vectors_.gather(end_));
  report.dt = dt;
  report.spectral_radius = spectral_radius();
  return report;
}

void ControlledIntegrator::interpolate(const double time, const Vectors& position) const {
  const double dt = step_end_ - step_start_;
  const double theta = dt > 0.0 ? (time - step_start_) / dt : 1.0;
  const double h00 = (1.0 + 2.0 * theta) * (1.0 - theta) * (1.0 - theta), h10 = theta * (1.0 - theta) * (1.0 - theta);
  const double h01 = theta * theta * (3.0 - 2.0 * theta), h11 = theta * theta * (theta - 1.0);
  vectors_.combine(scratch_, {{h00, start_}, {h10 * dt, start_velocity_}, {h01, end_}, {h11 * dt, end_velocity_}});
  Kokkos::deep_copy(ExecSpace(), position, vectors_.gather(scratch_));
  rhs_.project(position);
}

std::string ControlledIntegrator::describe() const {
  if (options_.fixed_step > 0.0) return fmt::format("{}, fixed dt = {:g}", name_, options_.fixed_step);
  return fmt::format("{}, error control at {:g} of the fiber's length per unit time", name_, options_.tolerance);
}

}  // namespace skein
