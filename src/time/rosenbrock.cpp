#include <skein/time/rosenbrock.hpp>

#include <skein/core/error.hpp>

#include "kernels/combination.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein {
namespace {

constexpr double gamma = 1.0 - 0.5 * std::numbers::sqrt2;
constexpr int max_iterations = 60;
constexpr double solver_share = 0.1;  // of the error allowed in a step
constexpr double max_scale_ratio = 2.0;  // of gamma dt to that of the preconditioner, either way

Linearization& get_linearization(RightHandSide& rhs) {
  Linearization* linearization = rhs.linearization();
  SKEIN_REQUIRE(linearization != nullptr, "a linearly implicit method needs the stiff part of the velocity's derivative");
  return *linearization;
}

}  // namespace

Rosenbrock::Rosenbrock(RightHandSide& rhs, const ControlOptions& options, const int n_nodes)
    : ControlledIntegrator(rhs, options, "ROS2", 2.0, n_nodes),
      linearization_(get_linearization(rhs)),
      gmres_(n_nodes, max_iterations),
      factorized_position_(make_vectors("factorized_position")),
      kept_position_(make_vectors("kept_position")),
      first_(make_vectors("first")),
      second_(make_vectors("second")) {}

void Rosenbrock::prepare(double, const ConstVectors& position, const ConstVectors&) {
  Kokkos::deep_copy(ExecSpace(), kept_position_, factorized_position_);
  linearization_.set_position(position);
}

void Rosenbrock::prepare_again(double, const ConstVectors&, const ConstVectors&, const std::string&) {}

void Rosenbrock::bring_memory_back() {
  if (preconditioner_.number != kept_.number) Kokkos::deep_copy(ExecSpace(), factorized_position_, kept_position_);
  preconditioner_ = kept_;
}

void Rosenbrock::factorize(const double scale) {
  if (!linearization_.factorize(factorized_position_, scale))
    throw Error(ExitCode::numerical, "the preconditioner of the linearly implicit step is singular");
  number_made_ = preconditioner_.number;
}

/// A new one where the step has changed much, or where the iterations that an older one costs more than a new one's
/// would pay for it.
void Rosenbrock::update_preconditioner(const double scale) {
  const double ratio = preconditioner_.scale > 0.0 ? scale / preconditioner_.scale : 0.0;
  if (ratio > max_scale_ratio || ratio * max_scale_ratio < 1.0 ||
      preconditioner_.excess > linearization_.factorization_cost()) {
    Kokkos::deep_copy(ExecSpace(), factorized_position_, start_);
    preconditioner_ = {scale, 0, 0.0, preconditioner_.number + 1};
    factorize(scale);
  } else if (number_made_ != preconditioner_.number) {  // after a restart, or a step that was given up
    factorize(preconditioner_.scale);
  }
}

std::string Rosenbrock::solve(const double dt, const ConstVectors& b, const Vectors& k) {
  const double tolerance = solver_share * allowed_error(dt) / dt;
  const Gmres::Result result = gmres_.solve(linearization_, gamma * dt, b, k, tolerance);
  iterations_ += result.iterations;
  if (result.converged) return {};
  if (!std::isfinite(result.residual)) return "GMRES met numbers that are not finite";
  return fmt::format("GMRES stalled after {} iterations at {:.3g} of its tolerance", result.iterations,
                     result.residual / tolerance);
}

ControlledIntegrator::Attempt Rosenbrock::attempt(const double time, const double dt) {
  const ExecSpace space;
  update_preconditioner(gamma * dt);
  iterations_ = 0;
  Attempt result;
  result.stages = 2;

  // (I - gamma dt A) k1 = F_n
  Kokkos::deep_copy(space, first_, 0.0);
  result.failure = solve(dt, start_velocity_, first_);
  if (!result.failure.empty()) return result;
  // (I - gamma dt A) k2 = F(y_n + dt k1) - 2 k1; k2 is nearly -k1.
  combine<ExecSpace>(space, end_, {1.0, start_}, {dt, first_});
  rhs_.compute_velocity(time + dt, end_, end_velocity_);
  combine<ExecSpace>(space, scratch_, {1.0, end_velocity_}, {-2.0, first_});
  combine<ExecSpace>(space, second_, {-1.0, first_}, {0.0, first_});
  result.failure = solve(dt, scratch_, second_);
  if (!result.failure.empty()) {
    // Leave what a search for the node to blame would find.
    combine<ExecSpace>(space, end_, {1.0, end_}, {1e-300, end_velocity_});
    return result;
  }
  combine<ExecSpace>(space, end_, {1.0, start_}, {1.5 * dt, first_});
  combine<ExecSpace>(space, end_, {1.0, end_}, {0.5 * dt, second_});
  rhs_.compute_velocity(time + dt, end_, end_velocity_);

  // The step against the trapezoidal rule, 0.94 of the local error for a decaying mode that is resolved; modes that are
  // not are damped by the preconditioner.
  combine<ExecSpace>(space, scratch_, {1.0, start_}, {-1.0, end_}, {0.5 * dt, start_velocity_},
                     {0.5 * dt, end_velocity_});
  linearization_.precondition(scratch_, scratch_);
  result.error = measure_error(scratch_, dt);

  if (preconditioner_.least_iterations == 0 || iterations_ < preconditioner_.least_iterations)
    preconditioner_.least_iterations = iterations_;
  preconditioner_.excess += iterations_ - preconditioner_.least_iterations;
  result.stages = iterations_ + 2;
  return result;
}

void Rosenbrock::visit_memory(MemoryVisitor& visitor) {
  ControlledIntegrator::visit_memory(visitor);
  visitor.number("ROS2.preconditioner_scale", preconditioner_.scale);
  visitor.count("ROS2.least_iterations", preconditioner_.least_iterations);
  visitor.number("ROS2.excess_iterations", preconditioner_.excess);
  visitor.integer("ROS2.factorizations", preconditioner_.number);
  visitor.vectors("ROS2.factorized_position", factorized_position_);
}

std::string Rosenbrock::describe() const {
  return ControlledIntegrator::describe() + "; linearly implicit, preconditioned by " + linearization_.describe();
}

}  // namespace skein
