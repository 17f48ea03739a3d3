// Starts that cannot be are refused, with what can be; what is said to be possible is.
#include <skein/core/error.hpp>
#include <skein/fibers/spring_network.hpp>
#include <skein/fibers/start_check.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

namespace skein {
namespace {

SceneConfig make_scene(const int sections, const int mode, const double amplitude, const double noise = 0.0) {
  SceneConfig scene;
  FiberConfig fiber;
  fiber.sections = sections;
  fiber.nodes_per_section = 6;
  fiber.start_mode = mode;
  fiber.start_amplitude = amplitude;
  fiber.start_noise = noise;
  scene.fibers = {fiber};
  return scene;
}

/// The number behind the last blank.
double last_number(const std::string& text) { return std::atof(text.substr(text.rfind(' ')).c_str()); }

/// Over all springs, from all nodes.
double measure_strain(const Fiber& fiber, const std::uint64_t seed) {
  const auto node = make_surface_nodes({fiber}, seed);
  const SpringNetwork network = make_spring_network(fiber);
  double strain = 0.0;
  for_each_spring(network, [&](const int a, const int b, const int entry) {
    strain = std::max(strain, std::abs(norm(node[a] - node[b]) / network.stencil.rest_length[entry] - 1.0));
  });
  return strain;
}

TEST(StartCheck, ModesThatSectionsDoNotResolveAreRefused) {
  EXPECT_TRUE(find_start_problems(make_scene(28, 7, 1e-3)).empty());
  for (const int mode : {8, 1000}) {
    const auto problems = find_start_problems(make_scene(28, mode, 1e-3));
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].key, "fiber.start_mode");
    EXPECT_NE(problems[0].message.find("at most 7 half waves"), std::string::npos) << problems[0].message;
  }
  EXPECT_TRUE(find_start_problems(make_scene(28, 1000, 0.0)).empty());  // no bend, no matter
  EXPECT_EQ(find_start_problems(make_scene(3, 1, 0.1)).at(0).key, "fiber.start_amplitude");
}

TEST(StartCheck, WhatIsSaidToBePossibleIs) {
  for (const auto& [sections, mode] : {std::pair{200, 5}, {200, 3}, {24, 2}, {40, 8}}) {
    const auto problems = find_start_problems(make_scene(sections, mode, 0.2));
    ASSERT_EQ(problems.size(), 1u) << sections << ' ' << mode;
    EXPECT_EQ(problems[0].key, "fiber.start_amplitude");
    const double largest = last_number(problems[0].message);
    EXPECT_GT(largest, 0.2 / mode / 3.0) << problems[0].message;
    EXPECT_LT(largest, 0.5 / mode + 1.0 / sections);
    SceneConfig scene = make_scene(sections, mode, largest);
    EXPECT_TRUE(find_start_problems(scene).empty()) << problems[0].message;
    EXPECT_LE(measure_strain(make_fibers(scene.fibers)[0], scene.seed), largest_sound_strain);
    scene.fibers[0].start_amplitude = 1.02 * largest;
    EXPECT_FALSE(find_start_problems(scene).empty());
  }
}

// Links keep their length in every bend: what is bounded is the strain of a tube's surface.
TEST(StartCheck, ChainsMayBendAsSharplyAsTubes) {
  SceneConfig scene = make_scene(60, 3, 0.2);
  FiberConfig& config = scene.fibers[0];
  config.model = FiberModel::chain;
  config.nodes_per_section = 1;
  config.spacing = 0.002;
  const auto problems = find_start_problems(scene);
  ASSERT_EQ(problems.size(), 1u);
  config.start_amplitude = last_number(problems[0].message);
  EXPECT_TRUE(find_start_problems(scene).empty()) << problems[0].message;
}

TEST(StartCheck, StrainIsTheLargestOfAllSprings) {
  for (const int reach : {1, 3}) {
    FiberConfig config = make_scene(60, 2, 0.05, 1e-3).fibers[0];
    config.reach_along = reach;
    config.roll = 17.0;
    const Fiber fiber = make_fibers({config})[0];
    EXPECT_NEAR(measure_start_strain(fiber, make_section_poses(fiber, 3)), measure_strain(fiber, 3), 1e-3);
  }
}

TEST(StartCheck, NoiseIsJudgedForEachCopy) {
  SceneConfig scene = make_scene(40, 1, 0.0, 0.02);
  const auto problems = find_start_problems(scene);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "fiber.start_noise");
  scene.fibers[0].start_noise = last_number(problems[0].message);
  EXPECT_GT(scene.fibers[0].start_noise, 1e-3);
  EXPECT_TRUE(find_start_problems(scene).empty());
  // Others of a hundred copies have stronger bends.
  scene.placement.kind = PlacementKind::random;
  scene.placement.count = 100;
  EXPECT_FALSE(find_start_problems(scene).empty());
}

TEST(StartCheck, NamesTheFiberAmongSeveral) {
  SceneConfig scene = make_scene(28, 1, 1e-3);
  scene.fibers.push_back(make_scene(28, 9, 1e-3).fibers[0]);
  const auto problems = find_start_problems(scene);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "fiber[1].start_mode");
}

// A thin tube folds so tightly that its legs meet before its springs are strained.
TEST(StartCheck, LegsThatMeetAreFound) {
  FiberConfig config = make_scene(400, 1, 0.0).fibers[0];
  const Fiber fiber = make_fibers({config})[0];
  std::vector<SectionPose> poses = make_section_poses(fiber, 1);
  EXPECT_FALSE(touches_itself(fiber, poses));
  // Legs side by side, a little over and a little under two radii apart, going on along x.
  for (const double apart : {2.1, 1.9}) {
    for (int s = 0; s < 400; ++s) {
      const int leg = s / 100, place = leg % 2 == 0 ? s % 100 : 99 - s % 100;
      poses[s].center = {apart * config.radius * leg, config.radius * place, 0.0};
    }
    EXPECT_EQ(touches_itself(fiber, poses), apart < 2.0);
  }
}

TEST(StartCheck, AnAmplitudeOutOfReachIsAnErrorOfTheScene) {
  const Fiber fiber = make_fibers(make_scene(200, 5, 0.2).fibers)[0];
  try {
    make_section_poses(fiber, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_error);
  }
}

}  // namespace
}  // namespace skein
