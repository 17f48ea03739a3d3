#include "rank_steps.hpp"

#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/solvers/right_hand_side_decorator.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

namespace skein::perf {
namespace {

template <class Function>
double time_fastest(const Function& function) {
  double fastest = 1e300;
  for (int repeat = 0; repeat < 20; ++repeat) fastest = std::min(fastest, time_call(function));
  return fastest;
}

/// Integrators that work with whole arrays on rank 0.
class WholeDynamics final : public RightHandSideDecorator {
 public:
  explicit WholeDynamics(RightHandSide& dynamics) : RightHandSideDecorator(dynamics) {}
  NodeVectors& vectors() override { return whole_vectors(); }
};

/// Steps of one kind, and the fastest of them by the time of an evaluation.
struct Steps {
  const char* name;
  FiberDynamics& dynamics;
  std::unique_ptr<Integrator> integrator{};
  State state{};
  double fastest = 1e300, per_evaluation = 0.0;
  FiberDynamics::Seconds parts{};
  RankTraffic traffic{};

  void take(SumTeam* team) {
    const FiberDynamics::Seconds before = dynamics.seconds();
    const RankTraffic sent = team != nullptr ? team->ranks().traffic() : RankTraffic{};
    const std::int64_t evaluations = dynamics.evaluations();
    const double seconds = time_call([&] { integrator->advance(state, 1.0); });
    const auto n = static_cast<double>(dynamics.evaluations() - evaluations);
    if (seconds / n >= fastest) return;
    fastest = seconds / n;
    per_evaluation = 1.0 / n;
    parts = {(dynamics.seconds().fluid - before.fluid) / n,
             (dynamics.seconds().springs_and_flow - before.springs_and_flow) / n};
    if (team == nullptr) return;
    const RankTraffic now = team->ranks().traffic();
    traffic = {(now.broadcast_bytes - sent.broadcast_bytes) / n, (now.gathered_bytes - sent.gathered_bytes) / n,
               (now.exchanged_bytes - sent.exchanged_bytes) / n, (now.shared_bytes - sent.shared_bytes) / n,
               (now.messages - sent.messages) / n};
  }
};

}  // namespace

void measure_steps(const int sections, const TimeMethod method, SumTeam* team, const int repeats) {
  SceneConfig scene;
  FiberConfig& fiber = scene.fibers.emplace_back();
  fiber.sections = sections;
  fiber.start_noise = 1e-11;
  scene.flows.emplace_back().rate = 2.5;
  scene.hydrodynamics.method = SumMethod::fmm;
  scene.hydrodynamics.tolerance = 1e-4;
  scene.hydrodynamics.check_every = 0;
  scene.time.method = method;
  scene.time.tolerance = 1e-4;
  Physics physics = make_physics(scene, team);
  FiberDynamics dynamics(physics), other_dynamics(physics);
  WholeDynamics whole(other_dynamics);
  const std::vector<Vec3> start = physics.make_start_nodes(1);
  const auto make_steps = [&](const char* name, FiberDynamics& of, RightHandSide& rhs) {
    Steps steps{name, of};
    steps.integrator = make_integrator(scene, physics, rhs);
    steps.state = {0.0, 0, to_device("skein::bench_ranks::position", start)};
    for (int step = 0; step < 10; ++step) steps.integrator->advance(steps.state, 1.0);  // until they are long
    return steps;
  };
  std::vector<Steps> ways;
  ways.push_back(make_steps("steps", dynamics, dynamics));
  if (team != nullptr && team->ranks().size() > 1) ways.push_back(make_steps("whole", other_dynamics, whole));
  const ConstVectors position = ways.front().state.position;
  const std::size_t n_ranks = static_cast<std::size_t>(team != nullptr ? team->ranks().size() : 1);
  const auto time_flow = [&](const std::size_t n_nodes) {
    const Vectors flow("skein::bench_ranks::flow", n_nodes);
    const ConstVectors some = Kokkos::subview(position, std::make_pair(std::size_t{0}, n_nodes), Kokkos::ALL());
    return time_fastest([&] { physics.flow->compute_velocity(0.0, some, flow); });
  };
  // Once a step, by rank 0 for all nodes.
  const Vectors copy("skein::bench_ranks::copy", position.extent(0));
  const double alone_seconds = time_fastest([&] {
    dynamics.find_fault(position);
    Kokkos::deep_copy(ExecSpace(), copy, position);
  });
  for (Steps& steps : ways) steps.dynamics.time_parts(true);
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (Steps& steps : ways) steps.take(team);
  std::printf(
      "steps,ranks,threads,nodes,evaluation_s,sum_s,forces_s,flow_s,integrator_s,alone_s,broadcast_B,shared_B,"
      "exchanged_B,gathered_B,messages\n");
  for (const Steps& steps : ways) {
    const double flow = time_flow(position.extent(0) / (&steps == &ways.front() ? n_ranks : 1));
    std::printf("%s,%d,%d,%d,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.3g\n", steps.name,
                team != nullptr ? team->ranks().size() : 0, HostSpace().concurrency(), position.extent_int(0),
                steps.fastest, steps.parts.fluid, steps.parts.springs_and_flow - flow, flow,
                steps.fastest - steps.parts.fluid - steps.parts.springs_and_flow, alone_seconds * steps.per_evaluation,
                steps.traffic.broadcast_bytes, steps.traffic.shared_bytes, steps.traffic.exchanged_bytes,
                steps.traffic.gathered_bytes, steps.traffic.messages);
  }
  std::fflush(stdout);
}

}  // namespace skein::perf
