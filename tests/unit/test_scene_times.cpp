// What a scene leaves to its own time scale, and what makes no sense beside it.

#include <skein/core/error.hpp>
#include <skein/physics/physics.hpp>
#include <skein/physics/scene_times.hpp>
#include <skein/scene/scene_file.hpp>

#include "tests/support/force_rows.hpp"
#include "tests/support/units_of_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skein {
namespace {

SceneConfig make_scene() {
  SceneConfig scene;
  scene.fibers.resize(2);
  return scene;
}

SceneConfig make_quiet_scene() {
  SceneConfig scene = make_scene();
  scene.flows = {};
  return scene;
}

std::string problem_of(const SceneConfig& scene) {
  try {
    resolve_times(scene);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_error);
    return error.what();
  }
  return "";
}

TEST(SceneTimes, AreThoseOfThePaperInItsShear) {
  const SceneConfig scene = resolve_times(make_scene());
  EXPECT_EQ(find_time_scale(scene), 0.4);
  EXPECT_EQ(scene.time.tolerance, 1e-4);
  EXPECT_EQ(scene.time.max_step, 0.1);
  EXPECT_EQ(scene.output.frame_interval, 0.05);
}

TEST(SceneTimes, AreKeptWhereTheyAreGiven) {
  SceneConfig scene = make_scene();
  scene.time.tolerance = 3e-3, scene.time.max_step = std::numeric_limits<double>::infinity();
  scene.output.frame_interval = 7.0;
  const SceneConfig resolved = resolve_times(scene);
  EXPECT_EQ(resolved.time.tolerance, 3e-3);
  EXPECT_EQ(resolved.time.max_step, scene.time.max_step);
  EXPECT_EQ(resolved.output.frame_interval, 7.0);
  // The same goes for what is resolved already, also once it was written and read.
  const SceneConfig read = read_scene_text(write_scene(resolved), "resolved", {}).config;
  EXPECT_EQ(write_scene(resolve_times(read)), write_scene(resolved));
}

TEST(SceneTimes, BalanceTheSumsWithTheSteps) {
  SceneConfig scene = make_scene();
  EXPECT_EQ(resolve_times(scene).hydrodynamics.tolerance, 1e-4);
  EXPECT_EQ(find_sum_tolerance(scene), 1e-4);
  // The same motion ten times slower, whose tolerance is a tenth by default, and by hand.
  scene.flows.front().rate *= 0.1;
  EXPECT_EQ(resolve_times(scene).hydrodynamics.tolerance, 1e-4);
  scene.time.tolerance = 2e-6;
  EXPECT_EQ(resolve_times(scene).hydrodynamics.tolerance, 2e-5);
  scene.time.tolerance = 1e-9;
  EXPECT_EQ(resolve_times(scene).hydrodynamics.tolerance, 1e-6);
  scene.time.tolerance = 0.02;
  EXPECT_EQ(resolve_times(scene).hydrodynamics.tolerance, 1e-3);
  scene.time.step = 0.01;
  EXPECT_EQ(resolve_times(scene).hydrodynamics.tolerance, 1e-5);
  scene.hydrodynamics.tolerance = 3e-7;
  EXPECT_EQ(resolve_times(scene).hydrodynamics.tolerance, 3e-7);
  EXPECT_EQ(find_sum_tolerance(scene), 3e-7);
}

TEST(SceneTimes, LeaveAFixedStepAsItIs) {
  SceneConfig scene = make_scene();
  scene.time.step = 0.3;
  const SceneConfig resolved = resolve_times(scene);
  EXPECT_EQ(write_scene(read_scene_text(write_scene(resolved), "resolved", {}).config), write_scene(resolved));
}

TEST(SceneTimes, GoWithTheUnits) {
  const test::Units units{0x1p-21, 0x1p17, 0x1p9};
  for (const auto& row : test::force_rows)
    for (SceneConfig scene : {make_scene(), make_quiet_scene()}) {
      row.configure(scene);
      const SceneConfig a = resolve_times(scene), b = resolve_times(test::rescale(scene, units));
      EXPECT_EQ(find_time_scale(b), units.time * find_time_scale(a)) << row.name;
      EXPECT_EQ(b.time.tolerance * units.time, a.time.tolerance) << row.name;
      EXPECT_EQ(b.time.max_step, units.time * a.time.max_step) << row.name;
      EXPECT_EQ(b.hydrodynamics.tolerance, a.hydrodynamics.tolerance) << row.name;
      EXPECT_EQ(b.output.frame_interval, units.time * a.output.frame_interval) << row.name;
    }
}

TEST(SceneTimes, AreThoseOfThePhysics) {
  for (const auto& row : test::force_rows)
    for (SceneConfig scene : {make_scene(), make_quiet_scene()}) {
      row.configure(scene);
      EXPECT_EQ(find_time_scale(scene), make_physics(scene).time_scale()) << row.name;
    }
}

// Of one size with what is known otherwise: the slowest bend of this fiber decays at 0.67
// (tests/accuracy/test_decay_rates).
TEST(SceneTimes, OfAFluidAtRestIsThatOfABend) {
  EXPECT_GT(find_time_scale(make_quiet_scene()), 1.0 / 0.67 / 3.0);
  EXPECT_LT(find_time_scale(make_quiet_scene()), 1.0 / 0.67 * 3.0);
  SceneConfig long_and_short = make_quiet_scene();
  long_and_short.fibers[0].sections = 300;
  EXPECT_EQ(find_time_scale(long_and_short), find_time_scale(make_quiet_scene()));
}

TEST(SceneTimes, OfForcesIsThatInWhichTheyCarryAFiber) {
  SceneConfig scene = make_quiet_scene();
  const double length = make_physics(scene).fibers[0].length();
  scene.tethers = {{0, 0, 1.0, {}, {0.0, 0.3, 0.4}, {}, 0.0}};
  EXPECT_NEAR(find_time_scale(scene), length / 0.5, 1e-14);
  scene.flows = {{.rate = 100.0}};
  EXPECT_EQ(find_time_scale(scene), 0.01);
  scene = make_quiet_scene();
  scene.tethers = {{0, 0, 1e6, {0.0, 3.0, 0.0}, {}, {}, 0.0}};  // that only holds
  EXPECT_EQ(find_time_scale(scene), find_time_scale(make_quiet_scene()));
}

TEST(SceneTimes, RefuseWhatMakesNoSense) {
  SceneConfig scene = make_scene();
  scene.time.tolerance = 100.0;
  EXPECT_NE(problem_of(scene).find("time.tolerance 100 allows an error of 40 fiber lengths within a time of 0.4"),
            std::string::npos)
      << problem_of(scene);
  scene.time.method = TimeMethod::euler, scene.time.step = 1e-4;  // which asks for none
  EXPECT_EQ(problem_of(scene), "");
  scene = make_scene();
  scene.time.tolerance = 1e-14;
  EXPECT_NE(problem_of(scene).find("below the rounding of positions"), std::string::npos);
  scene = make_scene();
  scene.flows[0].rate = 1e14;
  EXPECT_NE(problem_of(scene).find("would take more than 1e+12 steps"), std::string::npos) << problem_of(scene);
  scene.flows[0].rate = 1e8;
  EXPECT_NE(problem_of(scene).find("set output.frame_interval"), std::string::npos) << problem_of(scene);
  scene.flows[0].rate = 1e-8;  // a flow that does nearly nothing is none
  scene.time.tolerance = 1e-4;
  EXPECT_EQ(problem_of(scene), "");
}

}  // namespace
}  // namespace skein
