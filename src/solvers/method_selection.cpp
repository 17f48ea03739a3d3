#include <skein/solvers/method_selection.hpp>
#include <skein/solvers/rkc2_stages.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

// All measured, by processor time, on the L = 0.139, 0.196 and 0.523 orbits with 6 and 18 nodes on a section, springs
// 1, 10 and 100 times as stiff as the paper's and tolerances of 1e-2 to 1e-6; perf/plot_work_precision.py repeats it.
// The choice made took at most 1.4 times the other's time with the paper's springs.
constexpr double rkc2_step_share = 0.5;    // mean step over the largest one
constexpr double rkc2_radius_share = 0.4;  // evaluations a step for the spectral radius
constexpr double implicit_step_share = 0.7;
constexpr double steps_between_factorizations = 15.0;
constexpr double preference = 0.85;  // RKC2 cannot stall, and goes unless the other is clearly cheaper

/// TR-BDF2's evaluations a step: more where the matrix is stiffer, where the fiber has more sections than the
/// preconditioner sees, and where the flow turns the fiber far in a step.
double implicit_evaluations(const ControlOptions& options, const double dt, const double spectral_radius) {
  const double n_sections = options.detail_scale > 0.0 ? options.length_scale / options.detail_scale : 30.0;
  const double turn = dt / options.time_scale;
  return 3.3 * std::pow(n_sections / 30.0, 0.3) * std::pow(std::max(1.0, dt * spectral_radius), 0.12) *
         (1.0 + 6.0 * turn * turn);
}

/// In words, for the reason of a choice.
std::string describe_stiffness(const ControlOptions& options, const double spectral_radius, const ExpectedStep& step) {
  return fmt::format(
      "spectral radius {:.3g} = {:.3g} per shear time; a step of {:.3g} takes RKC2 about {:.0f} evaluations",
      spectral_radius, spectral_radius * options.time_scale, step.dt, step.evaluations);
}

}  // namespace

ExpectedStep expect_stabilized_step(const ControlOptions& options, const double spectral_radius) {
  const double dt = options.fixed_step > 0.0 ? options.fixed_step : rkc2_step_share * largest_controlled_step(options);
  const double stages = count_rkc2_stages(dt, rkc2_spectral_margin * spectral_radius);
  return {dt, stages, stages + rkc2_radius_share};
}

ExpectedStep expect_implicit_step(const ControlOptions& options, const double spectral_radius,
                                  const PreconditionerCost& preconditioner) {
  const double dt = options.fixed_step > 0.0 ? options.fixed_step
                                             : std::min(implicit_step_share * largest_controlled_step(options),
                                                        trbdf2_largest_step_ratio * options.time_scale);
  const double evaluations = preconditioner.iterations * implicit_evaluations(options, dt, spectral_radius);
  // Each product is preconditioned, and so is the error of the step.
  return {dt, evaluations,
          evaluations + (evaluations + 1.0) * preconditioner.use +
              preconditioner.factorization / steps_between_factorizations};
}

MethodSelection select_explicit_method(const ControlOptions& options, const double spectral_radius,
                                       const std::string& why) {
  const ExpectedStep step = expect_stabilized_step(options, spectral_radius);
  return {TimeMethod::rkc2, describe_stiffness(options, spectral_radius, step) + ", and " + why};
}

MethodSelection select_method(const ControlOptions& options, const double spectral_radius,
                              const PreconditionerCost& preconditioner) {
  const ExpectedStep stabilized = expect_stabilized_step(options, spectral_radius);
  const ExpectedStep implicit = expect_implicit_step(options, spectral_radius, preconditioner);
  const double stabilized_rate = stabilized.work / stabilized.dt, implicit_rate = implicit.work / implicit.dt;
  return {implicit_rate < preference * stabilized_rate ? TimeMethod::trbdf2 : TimeMethod::rkc2,
          fmt::format("{}, {:.0f} per unit of time; one of {:.3g} takes TR-BDF2 the work of {:.0f}, {:.0f} per unit of "
                      "time",
                      describe_stiffness(options, spectral_radius, stabilized), stabilized_rate, implicit.dt,
                      implicit.work, implicit_rate)};
}

}  // namespace skein
