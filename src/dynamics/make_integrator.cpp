#include <skein/core/error.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/solvers/euler.hpp>
#include <skein/solvers/explicit_runge_kutta.hpp>
#include <skein/solvers/method_selection.hpp>
#include <skein/solvers/rkc2.hpp>
#include <skein/solvers/selected_integrator.hpp>
#include <skein/solvers/spectral_radius.hpp>
#include <skein/solvers/tr_bdf2.hpp>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

Rkc2Options make_options(const SceneConfig& scene, const double length, const double spacing, const double time_scale) {
  Rkc2Options options;
  options.tolerance = scene.time.tolerance;
  options.length_scale = length;
  options.detail_scale = spacing;
  if (std::isfinite(time_scale)) options.time_scale = time_scale;
  options.fixed_step = scene.time.step;
  options.max_step = scene.time.max_step;
  options.displacement = 1e-5 * spacing;
  options.seed = scene.seed;
  return options;
}

// From the straight fibers of the start, also where a run goes on: the choice is the same then.
MethodSelection select(const Rkc2Options& options, const std::vector<Fiber>& fibers, RightHandSide& rhs) {
  const Vectors position = to_device("skein::make_integrator::position", make_surface_nodes(fibers));
  const Vectors velocity("skein::make_integrator::velocity", position.extent(0));
  rhs.compute_velocity(0.0, position, velocity);
  SpectralRadius power_iteration(position.extent_int(0), options.displacement, options.seed);
  const double radius = power_iteration.estimate(rhs, 0.0, position, velocity, 0.05, 30);
  const Linearization* linearization = rhs.linearization();
  return select_method(options, radius, linearization == nullptr ? 0.0 : linearization->factorization_cost(),
                       linearization == nullptr ? -1.0 : linearization->preconditioning_cost());
}

std::unique_ptr<Integrator> make_method(const TimeMethod method, const Rkc2Options& options,
                                        const std::vector<Fiber>& fibers, RightHandSide& rhs) {
  const int n_nodes = count_nodes(fibers);
  switch (method) {
    case TimeMethod::rkc2:
      return std::make_unique<Rkc2>(rhs, options, n_nodes);
    case TimeMethod::trbdf2:
      return std::make_unique<TrBdf2>(rhs, options, n_nodes);
    case TimeMethod::rk4:
      return std::make_unique<ExplicitRungeKutta>(rhs, options, make_classical_runge_kutta(), n_nodes);
    case TimeMethod::bs3:
      return std::make_unique<ExplicitRungeKutta>(rhs, options, make_bogacki_shampine(), n_nodes);
    case TimeMethod::euler:
      return std::make_unique<Euler>(rhs, options.fixed_step, options.length_scale, n_nodes);
    case TimeMethod::automatic: {
      const MethodSelection selection = select(options, fibers, rhs);
      return std::make_unique<SelectedIntegrator>(rhs, make_method(selection.method, options, fibers, rhs),
                                                  selection.reason);
    }
  }
  throw Error(ExitCode::internal, "make_method knows no such method of time integration");
}

}  // namespace

std::unique_ptr<Integrator> make_integrator(const SceneConfig& scene, const Physics& physics, RightHandSide& rhs) {
  const std::vector<Fiber>& fibers = physics.fibers;
  double spacing = fibers.front().spacing();
  for (const Fiber& fiber : fibers) spacing = std::min(spacing, fiber.spacing());
  const Rkc2Options options = make_options(scene, largest_length(fibers), spacing, physics.time_scale());
  return make_method(scene.time.method, options, fibers, rhs);
}

}  // namespace skein
