// What a sum over fibers' nodes and a step are expected to cost, and what is chosen by it.
#include <skein/arrays/default_path.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/dynamics/spectral_radius_at.hpp>
#include <skein/fmm/fmm_cost.hpp>
#include <skein/fmm/machine_rates.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace skein {
namespace {

SceneConfig make_scene(const int sections, const SumMethod sums, const double tolerance = 1e-4) {
  SceneConfig scene;
  scene.fibers.emplace_back().sections = sections;  // of 18 nodes, as the paper's
  scene.flows.emplace_back().rate = 2.5;
  scene.hydrodynamics.method = sums;
  scene.hydrodynamics.tolerance = tolerance;
  return scene;
}

NodeLines lines_of(const Physics& physics) {
  const Fiber& fiber = physics.fibers.front();
  return {static_cast<double>(fiber.n_nodes()), fiber.length(), fiber.config.blob};
}

TEST(SumCost, OfDirectSumsIsThatOfTheirPairs) {
  const NodeLines nodes{5000.0, 0.5, 0.002};
  const RateByPrecision pair = machine_rates(KernelPath::host).symmetric_direct_pair;
  EXPECT_EQ(DirectMobility(1.0, Precision::in_double, KernelPath::host).relative_cost(nodes), 1.0);
  EXPECT_DOUBLE_EQ(DirectMobility(1.0, Precision::in_single, KernelPath::host).relative_cost(nodes),
                   pair.in_single / pair.in_double);
}

// As where a sum finds out that the other method is cheaper: from the lists of its tree.
TEST(SumCost, OfTheFastMultipoleMethodIsWhatItsCountsSay) {
  for (const int sections : {301, 536, 1313})
    for (const double tolerance : {1e-3, 1e-4, 1e-6}) {
      const Physics physics = make_physics(make_scene(sections, SumMethod::fmm, tolerance));
      const NodeLines nodes = lines_of(physics);
      FmmOptions options;
      options.tolerance = tolerance;
      FmmMobility mobility(1.0, options);
      const double expected = mobility.relative_cost(nodes);
      const Vectors position = to_device("position", physics.make_start_nodes(1));
      const Vectors force("force", position.extent(0)), velocity("velocity", position.extent(0));
      Kokkos::deep_copy(force, 1.0);
      mobility.add_velocity({position, force, physics.blob}, position, velocity);
      const FmmStatistics& met = mobility.statistics();
      const double counted = estimate_relative_cost(met.work, met.plan, true, options);
      EXPECT_NEAR(expected / counted, 1.0, 0.2) << sections << " sections at " << tolerance;
      EXPECT_EQ(mobility.relative_cost(nodes), expected) << "no sum changes it";
    }
}

TEST(SumCost, OfTheFastMultipoleMethodIsNeverMoreThanTheDirectSumThatItMayTurnTo) {
  FmmOptions options;
  FmmMobility by_hand(1.0, options);
  options.direct_when_cheaper = true;
  FmmMobility by_itself(1.0, options);
  const NodeLines few{480.0, 0.046, 0.00225}, none{};
  EXPECT_GT(by_hand.relative_cost(few), 1.0);
  EXPECT_LE(by_itself.relative_cost(few), 1.0);
  EXPECT_EQ(by_itself.relative_cost(none), 1.0);
  EXPECT_EQ(DirectMobility(1.0, Precision::in_single, KernelPath::host).relative_cost(none), 1.0);
  options.tolerance = 1e-14;  // which only direct sums deliver
  EXPECT_LE(FmmMobility(1.0, options).relative_cost({1e5, 10.0, 0.00225}), 1.0);
}

// Blobs ask for leaves so large that none is far from another: then pairs in the precision that the tolerance allows
// are all there is to pay, and a direct sum, which is double, costs more.
TEST(SumCost, OfNodesThatAllMeetIsThatOfTheirPairs) {
  const Physics physics = make_physics(make_scene(84, SumMethod::fmm, 1e-6));
  FmmOptions options;
  options.tolerance = 1e-6;
  options.path = KernelPath::host;
  options.direct_when_cheaper = true;
  FmmMobility mobility(1.0, options);
  const Vectors position = to_device("position", physics.make_start_nodes(1));
  const Vectors force("force", position.extent(0)), velocity("velocity", position.extent(0));
  Kokkos::deep_copy(force, 1.0);
  const Sources sources{position, force, physics.blob};
  mobility.add_velocity(sources, position, velocity);
  const FmmStatistics& met = mobility.statistics();
  const double n_pairs = met.work.n_sources * met.work.n_targets;
  EXPECT_FALSE(met.used_direct_sum);
  EXPECT_EQ(met.work.far_pairs, 0.0);
  EXPECT_EQ(met.work.near_pairs, n_pairs);
  EXPECT_TRUE(met.plan.near_in_single);
  EXPECT_EQ(met.plan.tail_degree, 0) << "of which nobody has need";
  const MachineRates& rates = machine_rates(KernelPath::host);
  const double paid =
      rates.symmetric_near_pair.in_single * n_pairs + rates.node * 2.0 * met.work.n_sources + rates.tree;
  EXPECT_DOUBLE_EQ(estimate_relative_cost(met.work, met.plan, true, options),
                   paid / rates.direct_nanoseconds(true, false, n_pairs));
  EXPECT_LT(mobility.measure_error(sources, position, 200), 1e-6);
}

TEST(SumCost, FallsWithASymmetry) {
  SceneConfig scene = make_scene(301, SumMethod::direct), symmetric = scene;
  symmetric.symmetry.half_turn = SymmetryAxis::z;
  const double gain = make_physics(symmetric).symmetry->orbits().gain();
  EXPECT_GT(gain, 1.5);
  EXPECT_NEAR(make_physics(symmetric).relative_sum_cost() * gain, 1.0, 1e-12);
  scene.hydrodynamics.method = symmetric.hydrodynamics.method = SumMethod::fmm;
  EXPECT_NEAR(make_physics(symmetric).relative_sum_cost() * std::sqrt(gain), make_physics(scene).relative_sum_cost(),
              1e-12);
}

/// What the implicit method's matrix is made of and what it takes, in evaluations.
TEST(SumCost, NarrowsThePreconditioner) {
  const auto linearize = [](const SceneConfig& scene, const auto& look) {
    Physics physics = make_physics(scene);
    FiberDynamics dynamics(physics);
    look(*dynamics.linearization());
  };
  PreconditionerCost beside_direct;
  linearize(make_scene(301, SumMethod::direct), [&](Linearization& of_fiber) {
    EXPECT_NE(of_fiber.describe().find("5 sections"), std::string::npos);
    beside_direct = of_fiber.preconditioner_cost();
    EXPECT_EQ(beside_direct.iterations, 1.0);
    EXPECT_LT(beside_direct.use, 1.0);
  });
  linearize(make_scene(301, SumMethod::fmm), [&](Linearization& of_fiber) {
    EXPECT_NE(of_fiber.describe().find("1 section "), std::string::npos);
    const PreconditionerCost cost = of_fiber.preconditioner_cost();
    EXPECT_GT(cost.iterations, 1.0);
    EXPECT_GT(cost.use, beside_direct.use) << "a sum is 6 times as cheap, the matrix 2.6 times";
  });
}

TimeMethod chosen_for(SceneConfig scene) {
  scene.time.method = TimeMethod::automatic;
  scene.time.tolerance = 1e-4;
  Physics physics = make_physics(scene);
  FiberDynamics dynamics(physics);
  return make_integrator(scene, physics, dynamics)->method();
}

// The other method was measured to take 1.2 to 2 times as long, see docs/time_stepping.md.
TEST(SumCost, DecidesBetweenMethodsOfTimeIntegration) {
  // On a device the matrix would be the host's work.
  const TimeMethod implicit = default_path() == KernelPath::host ? TimeMethod::trbdf2 : TimeMethod::rkc2;
  EXPECT_EQ(chosen_for(make_scene(301, SumMethod::direct)), implicit);
  EXPECT_EQ(chosen_for(make_scene(301, SumMethod::fmm)), TimeMethod::rkc2);
  EXPECT_EQ(chosen_for(make_scene(536, SumMethod::automatic)), TimeMethod::rkc2);
  SceneConfig stiff = make_scene(301, SumMethod::fmm);
  stiff.fibers.front().spring_stiffness *= 100.0;
  EXPECT_EQ(chosen_for(stiff), implicit);
}

/// Of a fiber that turns over, after its first steps: about.
TEST(ExpectedSteps, AreThoseOfARun) {
  for (const TimeMethod method :
       {TimeMethod::euler, TimeMethod::rk4, TimeMethod::bs3, TimeMethod::rkc2, TimeMethod::trbdf2}) {
    SceneConfig scene = make_scene(28, SumMethod::direct);
    scene.fibers.front().nodes_per_section = 6;
    scene.time.method = method;
    scene.time.tolerance = 1e-4;
    if (method == TimeMethod::euler) scene.time.step = 1e-3;
    Physics physics = make_physics(scene);
    FiberDynamics dynamics(physics);
    const auto integrator = make_integrator(scene, physics, dynamics);
    State state{0.0, 0, to_device("position", physics.make_start_nodes(1))};
    const double radius = find_spectral_radius_at(physics, dynamics, 0.0, state.position, 1, rough_radius);
    const ExpectedStep expected = integrator->expect_step(radius);
    while (state.time < 1.0) integrator->advance(state, 3.0);
    const std::int64_t steps = state.step, evaluations = dynamics.evaluations();
    const double start = state.time;
    while (state.time < 3.0) integrator->advance(state, 3.0);
    const auto n_steps = static_cast<double>(state.step - steps);
    const auto n_evaluations = static_cast<double>(dynamics.evaluations() - evaluations);
    const double factor = method == TimeMethod::euler ? 1.01 : 2.5;
    EXPECT_LT((3.0 - start) / n_steps, factor * expected.dt) << static_cast<int>(method);
    EXPECT_GT((3.0 - start) / n_steps, expected.dt / factor) << static_cast<int>(method);
    EXPECT_LT(n_evaluations / n_steps, factor * expected.evaluations) << static_cast<int>(method);
    EXPECT_GT(n_evaluations / n_steps, expected.evaluations / factor) << static_cast<int>(method);
    EXPECT_GE(expected.work, expected.evaluations);
  }
}

}  // namespace
}  // namespace skein
