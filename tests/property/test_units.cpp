// One motion in other units of length, time and viscosity: the same steps, the same numbers, the same warnings. By
// powers of two nothing is rounded, and all agree to the last bit.

#include <skein/core/error.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/dynamics/make_integrator.hpp>
#include <skein/physics/scene_times.hpp>

#include "runs/model_guard.hpp"
#include "runs/observables.hpp"
#include "tests/reference/point_cloud.hpp"
#include "tests/support/units_of_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

using reference::Random;

FlowConfig make_random_flow(Random& random) {
  constexpr FlowKind kinds[] = {FlowKind::shear,    FlowKind::planar_extension, FlowKind::uniaxial_extension,
                                FlowKind::rotation, FlowKind::poiseuille,       FlowKind::vortices,
                                FlowKind::none};
  FlowConfig flow;
  flow.kind = kinds[random.bits() % 7];
  flow.rate = random.uniform(-4.0, 4.0);
  flow.center = random.in_cube(0.1);
  flow.size = random.uniform(0.1, 1.0);
  if (random.bits() % 2 == 0)
    flow.angular_frequency = random.uniform(1.0, 60.0), flow.phase = random.uniform(0.0, 90.0);
  if (random.bits() % 2 == 0) flow.start = random.uniform(0.0, 0.1);
  if (random.bits() % 2 == 0) flow.stop = flow.start + random.log_uniform(1e-4, 0.1);
  if (random.bits() % 2 == 0) flow.ramp = random.log_uniform(1e-4, 0.1);
  return flow;
}

FiberConfig make_random_fiber(Random& random, const Vec3 center) {
  FiberConfig fiber;
  fiber.sections = 5 + static_cast<int>(random.bits() % 6);
  fiber.nodes_per_section = 3 + static_cast<int>(random.bits() % 3);
  fiber.spring_stiffness = random.log_uniform(3e-4, 0.03);
  fiber.blob = random.uniform(0.003, 0.0049);
  fiber.center = center;
  fiber.direction = random.direction();
  if (random.bits() % 2 == 0) fiber.start_noise = 0.01;
  return fiber;
}

SceneConfig make_random_scene(Random& random) {
  constexpr TimeMethod methods[] = {TimeMethod::rkc2, TimeMethod::trbdf2, TimeMethod::automatic,
                                    TimeMethod::bs3,  TimeMethod::rk4,    TimeMethod::euler};
  SceneConfig scene;
  scene.seed = random.bits() % 1000;
  scene.fluid.viscosity = random.uniform(0.5, 2.0);
  scene.flows.clear();
  for (auto n = random.bits() % 3; n > 0; --n) scene.flows.push_back(make_random_flow(random));
  scene.fibers = {make_random_fiber(random, {})};
  if (random.bits() % 2 == 0) {
    scene.fibers.push_back(make_random_fiber(random, {0.02, 0.01, -0.02}));
    constexpr FiberModel models[] = {FiberModel::tube, FiberModel::chain, FiberModel::rigid};
    scene.fibers.back().model = models[random.bits() % 3];
    if (scene.fibers.back().is_rigid()) scene.fibers.back().start_noise = 0.0;
  }
  if (random.bits() % 2 == 0) scene.repulsion = {random.log_uniform(0.1, 10.0), random.uniform(0.002, 0.01)};
  if (random.bits() % 3 == 0) scene.gravity = {random.log_uniform(0.1, 10.0), random.direction()};
  if (random.bits() % 3 == 0)
    scene.tethers = {{0, -1, random.log_uniform(0.1, 3.0), random.in_cube(0.02), random.in_cube(0.3),
                      random.in_cube(0.01), random.uniform(0.0, 30.0)}};
  if (random.bits() % 3 == 0) scene.torques = {{0, 1, random.in_cube(1e-4), random.in_cube(20.0)}};
  if (random.bits() % 3 == 0)
    scene.clamps = {{0, 0, random.log_uniform(0.1, 3.0), random.in_cube(0.02), random.in_cube(0.01), random.direction(),
                     random.uniform(0.0, 90.0), random.in_cube(20.0), random.uniform(0.0, 30.0),
                     random.uniform(-9.0, 9.0)}};
  scene.time.method = methods[random.bits() % 6];
  if (scene.fibers.back().is_rigid() && scene.time.method == TimeMethod::trbdf2) scene.time.method = TimeMethod::bs3;
  const bool is_explicit = scene.time.method >= TimeMethod::rk4 || scene.time.method == TimeMethod::euler;
  scene.time.end = is_explicit ? 0.06 : 0.25;
  if (scene.time.method == TimeMethod::euler) scene.time.step = 5e-4;
  if (random.bits() % 2 == 0) scene.time.tolerance = random.log_uniform(1e-6, 1e-2);
  if (random.bits() % 3 == 0) scene.time.max_step = random.log_uniform(3e-3, 1e10);
  if (scene.time.max_step > 0.0) scene.time.max_step = std::max(scene.time.max_step, scene.time.step);
  return scene;
}

/// What is seen of a run.
struct Course {
  std::vector<double> time, error;
  std::vector<int> stages, rejected;
  std::vector<std::size_t> n_warnings;
  std::vector<Regime> regimes;
  std::vector<Vec3> nodes;
  double length = 0.0;
  bool is_given_up = false;  ///< before the end: some of these scenes tear their fibers
};

Course follow(const SceneConfig& scene) {
  constexpr int most_steps = 60;
  Physics physics = make_physics(scene);
  FiberDynamics dynamics(physics);
  const auto integrator = make_integrator(scene, physics, dynamics);
  State state{0.0, 0, to_device("position", make_surface_nodes(physics.fibers, scene.seed))};
  ModelGuard guard(physics.fibers, physics.has_force_between_fibers());
  Course course;
  while (state.time < scene.time.end && state.step < most_steps) {
    StepReport report;
    try {
      report = integrator->advance(state, scene.time.end);
    } catch (const Error& error) {
      if (error.code() != ExitCode::numerical) throw;
      course.is_given_up = true;
      break;
    }
    course.time.push_back(state.time);
    course.error.push_back(report.error);
    course.stages.push_back(report.stages);
    course.rejected.push_back(report.rejected);
    const StepMeasures measures = physics.measure(state.time, state.position);
    const StepRecord record = make_step_record(physics, state, report, measures);
    course.n_warnings.push_back(guard.look(record, measures.largest_strain).size());
  }
  course.regimes = classify_frame(physics.fibers, make_frame(physics, state.step, state.time, state.position));
  course.nodes = to_host(ConstVectors(state.position));
  course.length = physics.fibers.front().length();
  return course;
}

TEST(Units, OfPowersOfTwoChangeNoBit) {
  Random random(31);
  for (int trial = 0; trial < 50; ++trial) {
    const SceneConfig scene = make_random_scene(random);
    const auto power = [&](const int most) {
      return std::ldexp(1.0, static_cast<int>(random.bits() % (2 * most + 1)) - most);
    };
    const test::Units units{power(20), power(20), power(10)};
    SCOPED_TRACE("trial " + std::to_string(trial) + ", method " + std::to_string(static_cast<int>(scene.time.method)));
    const Course here = follow(scene), there = follow(test::rescale(scene, units));
    ASSERT_EQ(here.time.size(), there.time.size());
    for (std::size_t i = 0; i < here.time.size(); ++i)
      ASSERT_EQ(units.time * here.time[i], there.time[i]) << "step " << i;
    EXPECT_EQ(here.is_given_up, there.is_given_up);
    EXPECT_EQ(here.error, there.error);
    EXPECT_EQ(here.stages, there.stages);
    EXPECT_EQ(here.rejected, there.rejected);
    EXPECT_EQ(here.n_warnings, there.n_warnings);
    EXPECT_EQ(here.regimes, there.regimes);
    for (std::size_t i = 0; i < here.nodes.size(); ++i) ASSERT_EQ(units.length * here.nodes[i], there.nodes[i]);
  }
}

// Other units are rounded, and steps follow from estimates that see it: positions agree far below the tolerance.
TEST(Units, OfAnySizeChangeNothingButRounding) {
  Random random(32);
  for (int trial = 0; trial < 50; ++trial) {
    SceneConfig scene = make_random_scene(random);
    const test::Units units{random.log_uniform(1e-6, 1e6), random.log_uniform(1e-6, 1e6),
                            random.log_uniform(1e-3, 1e3)};
    SCOPED_TRACE("trial " + std::to_string(trial) + ", method " + std::to_string(static_cast<int>(scene.time.method)));
    const Course here = follow(scene), there = follow(test::rescale(scene, units));
    EXPECT_EQ(here.time.size(), there.time.size());
    EXPECT_EQ(here.regimes, there.regimes);
    if (here.time.size() != there.time.size() || here.time.size() == 60) continue;
    double worst = 0.0;
    for (std::size_t i = 0; i < here.nodes.size(); ++i)
      worst = std::max(worst, norm(here.nodes[i] - (1.0 / units.length) * there.nodes[i]) / here.length);
    EXPECT_LT(worst, 1e-7);
  }
}

}  // namespace
}  // namespace skein
