#include <skein/core/error.hpp>
#include <skein/solvers/method_selection.hpp>
#include <skein/solvers/rkc2.hpp>
#include <skein/solvers/rkc2_stages.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

constexpr int steps_between_refreshes = 25;
constexpr double refresh_accuracy = 0.02;
constexpr int first_iterations = 60;
constexpr int refresh_iterations = 12;
// The sum of the estimates over the largest true error: 0.6 to 0.8 on the L = 0.139 orbit, 1.2 to 1.5 on that of 0.196,
// 4 to 10 on that of 0.523, alike at all tolerances. Steps are left to the cautious estimate, reports are not.
constexpr double estimate_excess = 2.5;
constexpr int max_stages = 1000;  // rounding errors of a step grow with their square

}  // namespace

Rkc2::Rkc2(RightHandSide& rhs, const Rkc2Options& options, const int n_nodes)
    : ControlledIntegrator(rhs, options, "RKC2", 2.0, n_nodes, rhs.vectors()),
      power_iteration_(n_nodes, options.displacement, options.seed, vectors_),
      stage_{make_vectors("stage"), make_vectors("stage"), make_vectors("stage")},
      stage_velocity_(make_vectors("stage_velocity")) {}

void Rkc2::refresh_spectral_radius(const double time, const ConstVectors& position, const ConstVectors& velocity,
                                   const std::string& fault) {
  const bool first = is_first_step();
  const double estimate =
      power_iteration_.estimate(rhs_, time, position, velocity, refresh_accuracy * (first ? 0.1 : 1.0),
                                first ? first_iterations : refresh_iterations);
  if (!std::isfinite(estimate)) {
    const std::string what = fault.empty() ? find_velocity_fault(position, velocity) : fault;
    throw Error(ExitCode::numerical,
                fmt::format("t = {:.6g}: velocities are not finite{}{}", time, what.empty() ? "" : "; ", what));
  }
  spectral_radius_ = rkc2_spectral_margin * estimate;
  steps_since_refresh_ = 0;
}

void Rkc2::prepare(const double time, const ConstVectors& position, const ConstVectors& velocity) {
  if (is_first_step() || steps_since_refresh_ >= steps_between_refreshes)
    refresh_spectral_radius(time, position, velocity, "");
  ++steps_since_refresh_;
}

/// An underestimated radius shows as a rejection: look again, from the start of the step.
void Rkc2::prepare_again(const double time, const ConstVectors& position, const ConstVectors& velocity,
                         const std::string& fault) {
  refresh_spectral_radius(time, position, velocity, fault);
  ++steps_since_refresh_;
}

double Rkc2::probe_step() const {
  if (!(spectral_radius_ > 0.0)) return ControlledIntegrator::probe_step();
  return std::min(ControlledIntegrator::largest_step(), 1.0 / spectral_radius_);
}

double Rkc2::largest_step() const {
  double dt = ControlledIntegrator::largest_step();
  if (spectral_radius_ > 0.0)
    dt = std::min(dt, static_cast<double>(max_stages) * max_stages / (1.6 * spectral_radius_));
  return dt;
}

/// One step from start_ to end_ with the velocity there, both left in the members, and its error.
Rkc2::Attempt Rkc2::attempt(const double time, const double dt) {
  const int stages = count_rkc2_stages(dt, spectral_radius_);
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

  vectors_.combine(stage_[1], {{1.0, start_}, {mu_tilde * dt, start_velocity_}});
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
    compute_velocity(time + c_1 * dt, y_1, stage_velocity_);
    const Vectors& target = j == stages ? end_ : y;
    vectors_.combine(target, {{1.0 - mu - nu, start_},
                              {mu, y_1},
                              {nu, y_2},
                              {mu_tilde * dt, stage_velocity_},
                              {gamma_tilde * dt, start_velocity_}});
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
  compute_velocity(time + dt, end_, end_velocity_);
  vectors_.combine(scratch_, {{0.8, start_}, {-0.8, end_}, {0.4 * dt, start_velocity_}, {0.4 * dt, end_velocity_}});
  return {measure_error(scratch_, dt), stages, "", estimate_excess};
}

void Rkc2::visit_memory(MemoryVisitor& visitor) {
  ControlledIntegrator::visit_memory(visitor);
  visitor.count("RKC2.steps_since_refresh", steps_since_refresh_);
  visitor.number("RKC2.spectral_radius", spectral_radius_);
  power_iteration_.visit_memory(visitor);
}

ExpectedStep Rkc2::expect_step(const double spectral_radius) const {
  return expect_stabilized_step(options_, spectral_radius);
}

}  // namespace skein
