#include <skein/core/error.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/dynamics/spectral_radius_at.hpp>
#include <skein/physics/scene_times.hpp>
#include <skein/solvers/euler.hpp>
#include <skein/solvers/explicit_runge_kutta.hpp>
#include <skein/solvers/method_selection.hpp>
#include <skein/solvers/rkc2.hpp>
#include <skein/solvers/selected_integrator.hpp>
#include <skein/solvers/tr_bdf2.hpp>

#include <algorithm>

namespace skein {
namespace {

Rkc2Options make_options(const SceneConfig& scene, const Physics& physics) {
  const double time_scale = physics.time_scale();
  const TimeConfig time = resolve_time(scene.time, time_scale);
  Rkc2Options options;
  options.tolerance = time.tolerance;
  options.length_scale = largest_length(physics.fibers);
  options.detail_scale = physics.fibers.front().spacing();
  for (const Fiber& fiber : physics.fibers) options.detail_scale = std::min(options.detail_scale, fiber.spacing());
  // A looser tolerance than this, in a flow that does nearly nothing, is about shorter times.
  options.time_scale = std::min(time_scale, 0.4 / time.tolerance);
  options.fixed_step = time.step;
  options.max_step = time.max_step;
  options.displacement = small_displacement(physics);
  options.seed = scene.seed;
  return options;
}

// From the straight fibers of the start, also where a run goes on: the choice is the same then.
MethodSelection select(const Rkc2Options& options, const Physics& physics, RightHandSide& rhs) {
  const Vectors position = to_device("skein::make_integrator::position", physics.make_start_nodes(options.seed));
  const double radius = find_spectral_radius_at(physics, rhs, 0.0, position, options.seed, rough_radius);
  // Its factors are the host's work, also where evaluations are not: on a device 6 ms went into each evaluation of a
  // fiber of 5418 nodes, of which the sum was 0.6.
  if (!on_host<ExecSpace>)
    return select_explicit_method(options, radius, "the implicit method's factors would be the host's work");
  const Linearization* linearization = rhs.linearization();
  if (linearization == nullptr) return select_explicit_method(options, radius, "there is no implicit method for this");
  return select_method(options, radius, linearization->preconditioner_cost());
}

std::unique_ptr<Integrator> make_method(const TimeMethod method, const Rkc2Options& options, const Physics& physics,
                                        RightHandSide& rhs) {
  const int n_nodes = count_nodes(physics.fibers);
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
      const MethodSelection selection = select(options, physics, rhs);
      return std::make_unique<SelectedIntegrator>(rhs, make_method(selection.method, options, physics, rhs),
                                                  selection.reason);
    }
  }
  throw Error(ExitCode::internal, "make_method knows no such method of time integration");
}

}  // namespace

std::unique_ptr<Integrator> make_integrator(const SceneConfig& scene, const Physics& physics, RightHandSide& rhs) {
  return make_method(scene.time.method, make_options(scene, physics), physics, rhs);
}

}  // namespace skein
