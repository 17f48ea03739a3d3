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

/// What a step of RKC2 is expected to be, and to take.
struct StabilizedStep {
  double dt, stages;
  std::string description;
};

StabilizedStep expect_step(const ControlOptions& options, const double spectral_radius) {
  const double dt = options.fixed_step > 0.0 ? options.fixed_step : rkc2_step_share * largest_controlled_step(options);
  const double stages = count_rkc2_stages(dt, rkc2_spectral_margin * spectral_radius);
  return {dt, stages,
          fmt::format(
              "spectral radius {:.3g} = {:.3g} per shear time; a step of {:.3g} takes RKC2 about {:.0f} evaluations",
              spectral_radius, spectral_radius * options.time_scale, dt, stages)};
}

}  // namespace

MethodSelection select_explicit_method(const ControlOptions& options, const double spectral_radius,
                                       const std::string& why) {
  return {TimeMethod::rkc2, expect_step(options, spectral_radius).description + ", and " + why};
}

MethodSelection select_method(const ControlOptions& options, const double spectral_radius,
                              const PreconditionerCost& preconditioner) {
  const bool is_fixed = options.fixed_step > 0.0;
  const double largest = largest_controlled_step(options);
  const auto [dt, stages, stiffness] = expect_step(options, spectral_radius);
  const double implicit_dt =
      is_fixed ? options.fixed_step
               : std::min(implicit_step_share * largest, trbdf2_largest_step_ratio * options.time_scale);
  const double evaluations = preconditioner.iterations * implicit_evaluations(options, implicit_dt, spectral_radius);
  // Each product is preconditioned, and so is the error of the step.
  const double work = evaluations + (evaluations + 1.0) * preconditioner.use +
                      preconditioner.factorization / steps_between_factorizations;
  const double stabilized_rate = (stages + rkc2_radius_share) / dt, implicit_rate = work / implicit_dt;
  return {implicit_rate < preference * stabilized_rate ? TimeMethod::trbdf2 : TimeMethod::rkc2,
          fmt::format("{}, {:.0f} per unit of time; one of {:.3g} takes TR-BDF2 the work of {:.0f}, {:.0f} per unit of "
                      "time",
                      stiffness, stabilized_rate, implicit_dt, work, implicit_rate)};
}

}  // namespace skein
