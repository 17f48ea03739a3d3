#include "runs/pilot.hpp"

#include <skein/core/error.hpp>
#include <skein/core/stopwatch.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/physics/flow_summary.hpp>
#include <skein/physics/scene_times.hpp>

#include "runs/observables.hpp"
#include "runs/run_analyzer.hpp"

#include <memory>

namespace skein {

Pilot run_pilot(const SceneConfig& asked, const int n_intervals, const double max_seconds) {
  SKEIN_REQUIRE(n_intervals > 0, "a pilot has frames after its start");
  const SceneConfig scene = resolve_times(asked);
  Physics physics = make_physics(scene);
  FiberDynamics dynamics(physics);
  State state{0.0, 0, to_device("skein::Pilot::position", physics.make_start_nodes(scene.seed))};
  const auto integrator = make_integrator(scene, physics, dynamics);
  RunAnalyzer analyzer(
      scene, physics, [&](const Vec3 position) { return compute_typical_gradient(scene.flows, position); },
      /*with_forces=*/false);
  Pilot pilot;
  const auto add_frame = [&](const double time, const ConstVectors& position) {
    const Frame frame = make_frame(physics, state.step, time, position);
    analyzer.add(frame);
    pilot.centreline.push_back(frame.centreline);
  };
  const auto start = WallClock::now();
  const Vectors between("skein::Pilot::between", state.position.extent(0));
  add_frame(0.0, state.position);
  try {
    for (int i = 1; i <= n_intervals && !pilot.is_late; ++i) {
      const double due = i == n_intervals ? scene.time.end : scene.time.end * i / n_intervals;
      while (state.time < due && !pilot.is_late) {
        integrator->advance(state, scene.time.end);
        pilot.is_late = seconds_since(start) > max_seconds && state.time < scene.time.end;
      }
      if (state.time < due) break;
      if (state.time > due) integrator->interpolate(due, between);
      add_frame(due, state.time > due ? ConstVectors(between) : ConstVectors(state.position));
    }
  } catch (const Error& error) {
    if (error.code() != ExitCode::numerical) throw;
    pilot.failure = error.what();
  }
  pilot.seconds = seconds_since(start);
  pilot.evaluations = dynamics.evaluations();
  pilot.analysis = analyzer.take();
  return pilot;
}

}  // namespace skein
