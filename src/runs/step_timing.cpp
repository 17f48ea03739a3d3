#include "runs/step_timing.hpp"

#include <skein/core/stopwatch.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/physics/scene_times.hpp>

#include <utility>

namespace skein {

StepTiming time_steps(const SceneConfig& asked, const double seconds) {
  const SceneConfig scene = resolve_times(asked);
  Physics physics = make_physics(scene);
  FiberDynamics dynamics(physics);
  State state{0.0, 0, to_device("skein::time_steps::position", physics.make_start_nodes(scene.seed))};
  const auto integrator = make_integrator(scene, physics, dynamics);
  const auto advance_for = [&](const double longest) {
    const auto start = WallClock::now();
    do integrator->advance(state, scene.time.end);
    while (seconds_since(start) < longest && state.time < scene.time.end);
    Kokkos::fence();
    return seconds_since(start);
  };
  // The first steps find out how long steps may be.
  const auto start = WallClock::now();
  double dt = 0.0;
  // nvcc takes "call() < name && other.member <" for a template.
  const auto is_over = [&] { return seconds_since(start) >= seconds || state.time >= scene.time.end; };
  for (bool grows = true; grows && !is_over();) {
    const double before = std::exchange(dt, integrator->advance(state, scene.time.end).dt);
    grows = dt > 1.2 * before;
  }

  StepTiming timing;
  timing.n_nodes = count_nodes(physics.fibers);
  const double time_before = state.time;
  const std::int64_t evaluations_before = dynamics.evaluations();
  timing.seconds = advance_for(0.6 * seconds);
  timing.simulated_time = state.time - time_before;
  timing.evaluations = static_cast<double>(dynamics.evaluations() - evaluations_before);
  timing.mobility = physics.mobility->describe();

  // Timing the parts waits for a device in each evaluation, and so comes last.
  dynamics.time_parts(true);
  const double timed = advance_for(0.2 * seconds);
  timing.fluid_share = dynamics.seconds().fluid / timed;
  timing.springs_share = dynamics.seconds().springs_and_flow / timed;
  return timing;
}

}  // namespace skein
