#include <skein/core/error.hpp>
#include <skein/solvers/method_selection.hpp>
#include <skein/solvers/tr_bdf2.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace skein {
namespace {

constexpr double gamma = 2.0 - std::numbers::sqrt2;
constexpr double diagonal = 0.5 * gamma;                    // of both stages' equations
constexpr double side_weight = 0.25 * std::numbers::sqrt2;  // of both earlier velocities in the last stage

constexpr int max_iterations = 60;  // of GMRES
constexpr int max_newton_steps = 10;
constexpr double stage_share = 0.05;      // of the error allowed in a step, for a stage's equation
constexpr double solver_share = 0.5;      // of that, for a linear system
constexpr double newton_curvature = 5.0;  // rate of Newton's method over correction / node spacing, measured
constexpr double detail_share = 3e-3;     // of the node spacing, for a stage's equation
constexpr double least_error = 0.05;      // over the tolerance
constexpr double max_scale_ratio = 4.0;   // of the matrix' scale to that of the preconditioner, either way

Linearization& get_linearization(RightHandSide& rhs) {
  Linearization* linearization = rhs.linearization();
  SKEIN_REQUIRE(linearization != nullptr, "an implicit method needs the stiff part of the velocity's derivative");
  return *linearization;
}

}  // namespace

TrBdf2::TrBdf2(RightHandSide& rhs, const ControlOptions& options, const int n_nodes)
    : ControlledIntegrator(rhs, options, "TR-BDF2", 2.0, n_nodes, rhs.vectors()),
      linearization_(get_linearization(rhs)),
      gmres_(n_nodes, max_iterations, rhs.vectors()),
      factorized_position_(make_vectors("factorized_position")),
      acceleration_(make_vectors("acceleration")),
      next_acceleration_(make_vectors("next_acceleration")),
      middle_velocity_(make_vectors("middle_velocity")),
      constant_(make_vectors("constant")),
      correction_(make_vectors("correction")) {}

void TrBdf2::prepare(double, const ConstVectors&, const ConstVectors&) {
  if (is_next_ready_) std::swap(acceleration_, next_acceleration_);
  is_next_ready_ = false;
}

double TrBdf2::largest_step() const {
  return std::min(ControlledIntegrator::largest_step(), trbdf2_largest_step_ratio * options_.time_scale);
}

void TrBdf2::factorize(const double scale) {
  number_made_ = -1;  // a factorization that fails leaves none
  if (!linearization_.factorize(factorized_position_, scale))
    throw Error(ExitCode::numerical, "the preconditioner of the implicit step is singular");
  number_made_ = preconditioner_.number;
}

/// A new one where the step has changed much, or where the iterations that an older one costs more than a new one's
/// would pay for it.
void TrBdf2::update_preconditioner(const double scale) {
  const PreconditionerCost cost = linearization_.preconditioner_cost();
  const double ratio = preconditioner_.scale > 0.0 ? scale / preconditioner_.scale : 0.0;
  if (ratio > max_scale_ratio || ratio * max_scale_ratio < 1.0 ||
      preconditioner_.excess * (1.0 + cost.use) > cost.factorization) {
    vectors_.copy(factorized_position_, start_);
    preconditioner_ = {scale, -1.0, 0.0, preconditioner_.number + 1};
    factorize(scale);
  } else if (number_made_ != preconditioner_.number) {  // after a restart, or a step that was given up
    factorize(preconditioner_.scale);
  }
}

/// What a stage's equation may be off by, length: also where the fiber is long and the tolerance loose, little against
/// the node spacing, or stiff sections would be deformed by what the solver leaves.
double TrBdf2::stage_tolerance(const double dt) const {
  const double share = stage_share * allowed_error(dt);
  return options_.detail_scale > 0.0 ? std::min(share, detail_share * options_.detail_scale) : share;
}

std::string TrBdf2::solve_stage(const double time, const double dt, const ConstVectors& constant,
                                const Vectors& stage_velocity) {
  const double scale = diagonal * dt;
  const double tolerance = stage_tolerance(dt);
  double last_size = 0.0;
  for (int step = 0; step < max_newton_steps; ++step) {
    ++newton_steps_;
    compute_velocity(time, end_, stage_velocity);
    linearization_.set_position(inside_piece(time), end_);
    vectors_.combine(scratch_, {{1.0, constant}, {-1.0, end_}});
    vectors_.combine(scratch_, {{1.0, scratch_}, {scale, stage_velocity}});
    vectors_.set_to_zero(correction_);
    const Gmres::Result solved = gmres_.solve(linearization_, scale, scratch_, correction_, solver_share * tolerance);
    iterations_ += solved.iterations;
    vectors_.combine(end_, {{1.0, end_}, {1.0, correction_}});
    if (!std::isfinite(solved.residual)) {
      // Leave what a search for the node to blame would find.
      vectors_.combine(end_, {{1.0, end_}, {1e-300, stage_velocity}});
      return "GMRES met numbers that are not finite";
    }
    if (!solved.converged)
      return fmt::format("GMRES stalled after {} iterations at {:.3g} of its tolerance", solved.iterations,
                         solved.residual / (solver_share * tolerance));
    const double size = vectors_.root_mean_square(correction_);
    // What the matrix lacks is as slow as the flow, and it changes over distances like the node spacing: that is how
    // the error of the first step is guessed.
    const double bend = options_.detail_scale > 0.0 ? newton_curvature * size / options_.detail_scale : 0.0;
    const double rate = step == 0 ? std::min(0.5, scale / options_.time_scale + bend) : size / last_size;
    if (size == 0.0 || std::min(rate, 1.0) * size <= tolerance) {
      vectors_.combine(stage_velocity, {{1.0 / scale, end_}, {-1.0 / scale, constant}});
      return {};
    }
    if (step > 0 && rate > 2.0) return fmt::format("Newton's method does not converge (rate {:.2g})", rate);
    last_size = size;
  }
  return fmt::format("Newton's method took more than {} steps", max_newton_steps);
}

ControlledIntegrator::Attempt TrBdf2::attempt(const double time, const double dt) {
  update_preconditioner(diagonal * dt);
  iterations_ = newton_steps_ = 0;
  Attempt result;
  const auto count = [&] { result.stages = iterations_ + newton_steps_; };

  vectors_.combine(constant_, {{1.0, start_}, {diagonal * dt, start_velocity_}});
  vectors_.combine(end_, {{1.0, start_}, {gamma * dt, start_velocity_}});
  vectors_.combine(end_, {{1.0, end_}, {0.5 * gamma * gamma * dt * dt, acceleration_}});
  result.failure = solve_stage(time + gamma * dt, dt, constant_, middle_velocity_);
  count();
  if (!result.failure.empty()) {
    result.error = std::numeric_limits<double>::quiet_NaN();
    return result;
  }

  // From here on, the curve through both velocities known.
  const double curve = 0.5 * dt / gamma;
  vectors_.combine(end_, {{1.0, start_}, {dt, start_velocity_}});
  vectors_.combine(end_, {{1.0, end_}, {curve, middle_velocity_}, {-curve, start_velocity_}, {0.0, start_}});
  vectors_.combine(constant_, {{1.0, start_}, {side_weight * dt, start_velocity_}});
  vectors_.combine(constant_, {{1.0, constant_}, {side_weight * dt, middle_velocity_}});
  result.failure = solve_stage(time + dt, dt, constant_, end_velocity_);
  count();
  if (!result.failure.empty()) {
    result.error = std::numeric_limits<double>::quiet_NaN();
    return result;
  }

  // The difference to the third-order formula with the same velocities, freed of stiff modes by the preconditioner.
  vectors_.combine(scratch_, {{(4.0 * side_weight - 1.0) / 3.0 * dt, start_velocity_}, {-dt / 3.0, middle_velocity_}});
  vectors_.combine(scratch_, {{1.0, scratch_}, {2.0 / 3.0 * diagonal * dt, end_velocity_}});
  linearization_.precondition(scratch_, scratch_);
  // Not below what the stages' equations were left with, or the controller would take luck for a trend.
  const double error = measure_error(scratch_, dt);
  result.error = std::max(error, least_error);
  if (error > 0.0) result.excess = result.error / error;

  vectors_.combine(next_acceleration_, {{1.0 / dt, end_velocity_}, {-1.0 / dt, start_velocity_}});
  is_next_ready_ = true;
  Preconditioner& made = preconditioner_;
  if (made.least_iterations < 0.0 || iterations_ < made.least_iterations) made.least_iterations = iterations_;
  made.excess += iterations_ - made.least_iterations;
  return result;
}

void TrBdf2::visit_memory(MemoryVisitor& visitor) {
  ControlledIntegrator::visit_memory(visitor);
  visitor.number("TR-BDF2.preconditioner_scale", preconditioner_.scale);
  visitor.number("TR-BDF2.least_iterations", preconditioner_.least_iterations);
  visitor.number("TR-BDF2.excess_iterations", preconditioner_.excess);
  visitor.integer("TR-BDF2.factorizations", preconditioner_.number);
  visitor.node_vectors("TR-BDF2.factorized_position", vectors_, factorized_position_);
  visitor.node_vectors("TR-BDF2.acceleration", vectors_, is_next_ready_ ? next_acceleration_ : acceleration_);
}

ExpectedStep TrBdf2::expect_step(const double spectral_radius) const {
  return expect_implicit_step(options_, spectral_radius, linearization_.preconditioner_cost());
}

std::string TrBdf2::describe() const {
  return ControlledIntegrator::describe() + "; implicit, preconditioned by " + linearization_.describe();
}

}  // namespace skein
