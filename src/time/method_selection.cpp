#include <skein/time/method_selection.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include <skein/time/rkc2.hpp>

namespace skein {
namespace {

// Of TR-BDF2, measured on the L = 0.139 half turn: 4 to 8 evaluations a step with 6 nodes on a section, 14 with 18.
constexpr double implicit_evaluations = 14.0;
constexpr double steps_between_factorizations = 20.0;
constexpr double rkc2_margin = 1.2;  // of its spectral radius

}  // namespace

MethodSelection select_method(const ControlOptions& options, const double spectral_radius, const double factorization,
                              const double preconditioning) {
  // Both methods' errors are alike at equal steps, which are mostly the largest that the tolerance allows.
  const double dt = options.fixed_step > 0.0 ? options.fixed_step : largest_controlled_step(options);
  const double stabilized = Rkc2::stages_for(dt, rkc2_margin * spectral_radius);
  const std::string stiffness = fmt::format(
      "spectral radius {:.3g} = {:.3g} per shear time; a step of {:.3g} takes RKC2 about {:.0f} evaluations",
      spectral_radius, spectral_radius * options.time_scale, dt, stabilized);
  if (preconditioning < 0.0) return {"rkc2", stiffness + ", and there is no implicit method for this"};
  const double implicit = implicit_evaluations * (1.0 + preconditioning) + factorization / steps_between_factorizations;
  return {implicit < stabilized ? "trbdf2" : "rkc2",
          fmt::format("{}, TR-BDF2 the work of {:.1f}", stiffness, implicit)};
}

SelectedIntegrator::SelectedIntegrator(std::unique_ptr<Integrator> integrator, std::string reason)
    : integrator_(std::move(integrator)), reason_(std::move(reason)) {}

std::string SelectedIntegrator::describe() const {
  return integrator_->describe() + "\n  chosen automatically: " + reason_;
}

}  // namespace skein
