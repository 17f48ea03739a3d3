// A scene that is written is read back to the same bits, and keys that are missing are what they are by default.

#include <skein/scene/scene_reference.hpp>

#include "tests/unit/scene_text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace skein {
namespace {

// Values that differ from their defaults, many of which have no short decimal form.
SceneConfig make_unusual_scene() {
  SceneConfig scene;
  scene.title = "quotes \" and \\, a tab\t, a line\nand \xc3\xa9";
  scene.seed = 9223372036854775807u;
  scene.fluid.viscosity = 1.0 / 3.0;
  scene.flows = {
      {FlowKind::vortices, -1e-7 / 7.0, {1.0 / 3.0, -2.0, 1e-9}, 0.7 / 3.0, -1.0 / 7.0, 33.3, 1.0 / 9.0, 2.2, 1e-3},
      {.kind = FlowKind::none, .rate = 0.1}};
  scene.fibers.resize(3);
  scene.fibers[0] = {FiberModel::tube,        113,  9, 0.1 + 0.2, 1e-9 / 3.0, 0.2 / 7.0, {1e15, -0.1, 1.0 / 7.0},
                     {0.0, 2.0, -1e-3 / 9.0}, -33.3};
  scene.fibers[1].blob = 5e-3 / 1.7;
  scene.fibers[1].start_mode = 3;
  scene.fibers[1].start_amplitude = 0.1 / 7.0;
  scene.fibers[1].start_plane = -10.0 / 3.0;
  scene.fibers[1].start_noise = 1e-3 / 3.0;
  scene.fibers[1].stiffness_profile = {{0.1 / 3.0, 1e-3 / 7.0}, {0.5, 20.0 / 3.0}, {1.0, 1.0}};
  scene.fibers[1].stiffness_within_sections = 1.0 / 3.0;
  scene.fibers[1].stiffness_between_sections = 7.0 / 3.0;
  scene.fibers[1].reach_along = 3;
  scene.fibers[1].reach_around = 4;
  scene.fibers[1].spacing = 2e-3 / 3.0;
  scene.fibers[2].model = FiberModel::chain;
  scene.fibers[2].nodes_per_section = 1;
  scene.fibers[2].spacing = 1.0 / 70.0;
  scene.fibers[2].bending_rigidity = 1e-6 / 7.0;
  scene.fibers[2].shear_couple = 1e-4 / 3.0;
  scene.fibers[2].end_couple = 1e-6 / 3.0;
  scene.placement = {
      PlacementKind::grid, {0.1, 1.0 / 3.0, -7.0}, {2.0, 3.0, 4.0}, {0.3, 1.0 / 7.0, 2.0}, 7, {3.0, 4.0, 1.0 / 3.0},
      1e-3 / 3.0,          Orientation::random};
  scene.repulsion = {7.0 / 3.0, 1e-3 / 7.0};
  scene.hydrodynamics.precision = Precision::in_single;
  scene.time = {TimeMethod::euler, 17.0 / 3.0, 1e-4 / 3.0, 1e-7 / 3.0, 0.1 / 3.0, 0.0, {}};
  scene.output = {1.0 / 30.0, Precision::in_single};
  return scene;
}

TEST(SceneFile, MissingKeysKeepTheDefaultsOfTheStructs) {
  SceneConfig defaults;
  defaults.fibers.resize(1);
  EXPECT_EQ(write_scene(read("[fiber]\n")), write_scene(defaults));
  EXPECT_TRUE(read("[fiber]\n") == defaults);
}

TEST(SceneFile, TakesEveryKind) {
  const SceneConfig scene = read(
      "title = 'one'\nseed = 7\nfluid.viscosity = 2\n[flow]\nkind = \"none\"\n"
      "[[fiber]]\nsections = 12\ncenter = [1, 2.5, -3e-1]\n[[fiber]]\nroll = 20.0\n");
  EXPECT_EQ(scene.title, "one");
  EXPECT_EQ(scene.seed, 7u);
  EXPECT_EQ(scene.fluid.viscosity, 2.0);
  ASSERT_EQ(scene.flows.size(), 1u);
  EXPECT_EQ(scene.flows[0].kind, FlowKind::none);
  ASSERT_EQ(scene.fibers.size(), 2u);
  EXPECT_EQ(scene.fibers[0].sections, 12);
  EXPECT_EQ(scene.fibers[0].center, (Vec3{1.0, 2.5, -0.3}));
  EXPECT_EQ(scene.fibers[1].sections, 80);
  EXPECT_EQ(scene.fibers[1].roll, 20.0);
}

TEST(SceneFile, WrittenSceneReadsBackToTheSameBits) {
  const SceneConfig scene = make_unusual_scene();
  const std::string written = write_scene(scene);
  EXPECT_EQ(write_scene(read(written)), written);
  EXPECT_TRUE(read(written) == scene);
}

// What a run folder holds must serve whoever resumes the run.
TEST(SceneFile, AReadableSceneIsTheWrittenOne) {
  const SceneConfig scene = make_unusual_scene();
  EXPECT_EQ(write_readable_scene(scene), write_scene(scene));
}

TEST(SceneFile, AnyTitleInUtf8IsReadBack) {
  SceneConfig scene = read("[fiber]\n");
  for (unsigned code = 1; code < 0x110000; code += code < 0x3000 ? 1 : 97) {
    if (code >= 0xd800 && code < 0xe000) continue;  // no characters
    std::string character;
    if (code < 0x80) {
      character = {static_cast<char>(code)};
    } else if (code < 0x800) {
      character = {static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 0x3f))};
    } else if (code < 0x10000) {
      character = {static_cast<char>(0xe0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 0x3f)),
                   static_cast<char>(0x80 | (code & 0x3f))};
    } else {
      character = {static_cast<char>(0xf0 | code >> 18), static_cast<char>(0x80 | (code >> 12 & 0x3f)),
                   static_cast<char>(0x80 | (code >> 6 & 0x3f)), static_cast<char>(0x80 | (code & 0x3f))};
    }
    scene.title += character;
  }
  EXPECT_EQ(read(write_readable_scene(scene)).title, scene.title);
}

TEST(SceneFile, ASceneThatCouldNotBeReadAgainIsRefused) {
  SceneConfig scene = read("[fiber]\n");
  scene.title = "caf\xe9";
  EXPECT_THROW(write_readable_scene(scene), Error);
  scene.title = std::string(largest_scene, 'x');
  try {
    write_readable_scene(scene);
    ADD_FAILURE() << "a scene of more than is read was written";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_error);
    EXPECT_NE(std::string(error.what()).find("64 MiB"), std::string::npos) << error.what();
  }
}

TEST(SceneFile, WrittenSceneShowsAllKeysOfTheDefaults) {
  SceneConfig defaults;
  defaults.fibers.resize(1);
  // The defaults with comments taken out are the plain scene.
  std::string plain;
  std::string line;
  for (const char c : write_commented_defaults()) {
    line += c;
    if (c != '\n') continue;
    // Nor is the list there that only a run that was prolonged has.
    if (line[0] != '#' && line != "earlier_ends = []\n") plain += line;
    line.clear();
  }
  EXPECT_EQ(plain.substr(plain.find("title")), write_scene(defaults));
}

}  // namespace
}  // namespace skein
