#include <skein/scene/nearest_name.hpp>
#include <skein/scene/scene_file.hpp>
#include <skein/scene/scene_reference.hpp>
#include <skein/scene/words.hpp>

#include "tests/support/nan_trap.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace skein {
namespace {

SceneConfig read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_scene_text(text, "scene.toml", overrides).config;
}

std::vector<std::string> problems_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> lines;
  try {
    read(text, overrides);
  } catch (const SceneError& error) {
    for (const Problem& problem : error.problems()) {
      const std::string description = problem.describe();
      lines.push_back(description.substr(0, description.find('\n')));
    }
  }
  return lines;
}

// Every value differs from its default, and many have no short decimal form.
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
  scene.time = {TimeMethod::euler, 17.0 / 3.0, 1e-4 / 3.0, 1e-7 / 3.0, 0.1 / 3.0};
  scene.output = {1.0 / 30.0, Precision::in_single};
  return scene;
}

void expect_same(const SceneConfig& a, const SceneConfig& b) {
  EXPECT_EQ(a.title, b.title);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.fluid.viscosity, b.fluid.viscosity);
  ASSERT_EQ(a.flows.size(), b.flows.size());
  for (std::size_t i = 0; i < a.flows.size(); ++i) {
    EXPECT_EQ(a.flows[i].kind, b.flows[i].kind);
    EXPECT_EQ(a.flows[i].rate, b.flows[i].rate);
    EXPECT_EQ(a.flows[i].center, b.flows[i].center);
    EXPECT_EQ(a.flows[i].size, b.flows[i].size);
    EXPECT_EQ(a.flows[i].angular_frequency, b.flows[i].angular_frequency);
    EXPECT_EQ(a.flows[i].phase, b.flows[i].phase);
    EXPECT_EQ(a.flows[i].start, b.flows[i].start);
    EXPECT_EQ(a.flows[i].stop, b.flows[i].stop);
    EXPECT_EQ(a.flows[i].ramp, b.flows[i].ramp);
  }
  EXPECT_EQ(a.placement.kind, b.placement.kind);
  EXPECT_EQ(a.placement.center, b.placement.center);
  EXPECT_EQ(a.placement.grid, b.placement.grid);
  EXPECT_EQ(a.placement.spacing, b.placement.spacing);
  EXPECT_EQ(a.placement.count, b.placement.count);
  EXPECT_EQ(a.placement.box, b.placement.box);
  EXPECT_EQ(a.placement.gap, b.placement.gap);
  EXPECT_EQ(a.placement.orientation, b.placement.orientation);
  ASSERT_EQ(a.fibers.size(), b.fibers.size());
  for (std::size_t i = 0; i < a.fibers.size(); ++i) {
    EXPECT_EQ(a.fibers[i].sections, b.fibers[i].sections);
    EXPECT_EQ(a.fibers[i].nodes_per_section, b.fibers[i].nodes_per_section);
    EXPECT_EQ(a.fibers[i].radius, b.fibers[i].radius);
    EXPECT_EQ(a.fibers[i].spring_stiffness, b.fibers[i].spring_stiffness);
    EXPECT_EQ(a.fibers[i].blob, b.fibers[i].blob);
    EXPECT_EQ(a.fibers[i].center, b.fibers[i].center);
    EXPECT_EQ(a.fibers[i].direction, b.fibers[i].direction);
    EXPECT_EQ(a.fibers[i].roll, b.fibers[i].roll);
    EXPECT_EQ(a.fibers[i].start_mode, b.fibers[i].start_mode);
    EXPECT_EQ(a.fibers[i].start_amplitude, b.fibers[i].start_amplitude);
    EXPECT_EQ(a.fibers[i].start_plane, b.fibers[i].start_plane);
    EXPECT_EQ(a.fibers[i].start_noise, b.fibers[i].start_noise);
    EXPECT_EQ(a.fibers[i].stiffness_profile, b.fibers[i].stiffness_profile);
    EXPECT_EQ(a.fibers[i].stiffness_within_sections, b.fibers[i].stiffness_within_sections);
    EXPECT_EQ(a.fibers[i].stiffness_between_sections, b.fibers[i].stiffness_between_sections);
    EXPECT_EQ(a.fibers[i].reach_along, b.fibers[i].reach_along);
    EXPECT_EQ(a.fibers[i].reach_around, b.fibers[i].reach_around);
  }
  EXPECT_EQ(a.repulsion.strength, b.repulsion.strength);
  EXPECT_EQ(a.repulsion.range, b.repulsion.range);
  EXPECT_EQ(a.hydrodynamics.method, b.hydrodynamics.method);
  EXPECT_EQ(a.hydrodynamics.precision, b.hydrodynamics.precision);
  EXPECT_EQ(a.time.method, b.time.method);
  EXPECT_EQ(a.time.start, b.time.start);
  EXPECT_EQ(a.time.end, b.time.end);
  EXPECT_EQ(a.time.earlier_ends, b.time.earlier_ends);
  EXPECT_EQ(a.time.step, b.time.step);
  EXPECT_EQ(a.time.tolerance, b.time.tolerance);
  EXPECT_EQ(a.time.max_step, b.time.max_step);
  EXPECT_EQ(a.start.checksum, b.start.checksum);
  EXPECT_EQ(a.start.parent, b.start.parent);
  EXPECT_EQ(a.start.certificate, b.start.certificate);
  EXPECT_EQ(a.start.step, b.start.step);
  EXPECT_EQ(a.output.frame_interval, b.output.frame_interval);
  EXPECT_EQ(a.output.precision, b.output.precision);
}

TEST(SceneFile, MissingKeysKeepTheDefaultsOfTheStructs) {
  SceneConfig defaults;
  defaults.fibers.resize(1);
  expect_same(read("[fiber]\n"), defaults);
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
  expect_same(read(written), scene);
  EXPECT_EQ(write_scene(read(written)), written);
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

TEST(SceneOverrides, MustBeUtf8) {
  for (const char* text : {"title=caf\xe9", "title=\"caf\xe9\"", "t\xc3=1", "flow.kind=\xff", "title=\xed\xa0\x80"}) {
    const auto problems = problems_of("[fiber]\n", {text});
    ASSERT_EQ(problems.size(), 1u) << text;
    EXPECT_EQ(problems[0].find("--set "), 0u) << problems[0];
    EXPECT_NE(problems[0].find("is no UTF-8"), std::string::npos) << problems[0];
  }
  EXPECT_EQ(read("[fiber]\n", {"title=caf\xc3\xa9"}).title, "caf\xc3\xa9");
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

TEST(SceneOverrides, ApplyToAllFibersOrOne) {
  const std::string text = "[[fiber]]\nsections = 10\n[[fiber]]\n[[fiber]]\nsections = 30\n";
  const SceneConfig all = read(text, {"fiber.sections=113", "fiber[1].roll=30.0", "fiber[2].sections=7"});
  EXPECT_EQ(all.fibers[0].sections, 113);
  EXPECT_EQ(all.fibers[1].sections, 113);
  EXPECT_EQ(all.fibers[2].sections, 7);
  EXPECT_EQ(all.fibers[0].roll, 0.0);
  EXPECT_EQ(all.fibers[1].roll, 30.0);
  EXPECT_EQ(read("[fiber]\n", {"fiber[0].roll=15"}).fibers[0].roll, 15.0);
}

TEST(SceneFile, SeveralFlowsAddUpAndOverridesNameThem) {
  const std::string text = "[fiber]\n[[flow]]\nkind = \"shear\"\n[[flow]]\nkind = \"rotation\"\nrate = -1\n";
  const SceneConfig scene = read(text, {"flow[1].rate=0.5", "flow.ramp=0.1"});
  ASSERT_EQ(scene.flows.size(), 2u);
  EXPECT_EQ(scene.flows[0].kind, FlowKind::shear);
  EXPECT_EQ(scene.flows[0].rate, 2.5);
  EXPECT_EQ(scene.flows[1].kind, FlowKind::rotation);
  EXPECT_EQ(scene.flows[1].rate, 0.5);
  EXPECT_EQ(scene.flows[0].ramp, 0.1);
  EXPECT_EQ(scene.flows[1].ramp, 0.1);
  EXPECT_EQ(read("[fiber]\n", {"flow[0].rate=3.5"}).flows[0].rate, 3.5);
  EXPECT_EQ(problems_of("[fiber]\n", {"flow[1].rate=3.5"}),
            std::vector<std::string>{"--set flow[1].rate=3.5: there is no flow[1]: the scene's last is flow[0]"});
}

TEST(SceneFile, AProfileIsPairsInOrder) {
  const std::string key = "[fiber]\nstiffness_profile = ";
  EXPECT_EQ(read(key + "[[0, 1], [0.5, 0.25], [1, 2.5]]\n").fibers[0].stiffness_profile,
            (std::vector<ProfilePoint>{{0.0, 1.0}, {0.5, 0.25}, {1.0, 2.5}}));
  const test::MeantNan one_value_is_none;
  for (const char* wrong : {"[[0, 1]]", "[[0, 1], [1]]", "[[0, 1], 2]", "[[0, 1], [1, nan]]", "[[0, 1], [1, -1]]",
                            "[[0.5, 1], [0.5, 1]]", "[[0, 1], [1.5, 1]]", "[[0, 1], [1, 0]]", "1.0"})
    EXPECT_EQ(problems_of(key + wrong + "\n").size(), 1u) << wrong;
  std::string many;
  for (int i = 0; i < 64; ++i) many += "[" + std::to_string(i / 64.0) + ", 1.0], ";
  EXPECT_EQ(read(key + "[" + many + "]\n").fibers[0].stiffness_profile.size(), 64u);
  EXPECT_EQ(problems_of(key + "[" + many + "[1.0, 1.0]]\n").size(), 1u);
}

TEST(SceneFile, AGridIsMadeOfWholeNumbersAndItsNodesAreCounted) {
  const std::string fiber = "[fiber]\nsections = 100\nnodes_per_section = 1000\n[placement]\nkind = \"grid\"\n";
  EXPECT_EQ(problems_of(fiber + "grid = [1.5, 1, 1]\n").size(), 1u);
  EXPECT_EQ(problems_of(fiber + "grid = [10, 10, 10]\n").size(), 0u);
  EXPECT_EQ(problems_of(fiber + "grid = [10, 10, 11]\n").size(), 1u);
  EXPECT_EQ(problems_of("[fiber]\n[placement]\nkind = \"grid\"\ngrid = [100, 101, 1]\n").size(), 1u);
}

TEST(SceneFile, ARepulsionFitsTheThinnestFiber) {
  EXPECT_EQ(read("[fiber]\n").repulsion.strength, 0.0);
  const std::string start = "[[fiber]]\n[[fiber]]\nradius = 0.003\n[repulsion]\nstrength = 1.5\nrange = ";
  for (const char* sound : {"0", "0.012", "3e-5"}) EXPECT_EQ(problems_of(start + sound + "\n").size(), 0u) << sound;
  for (const char* wrong : {"0.0121", "2.9e-5", "-0.001", "nan", "\"0.001\""})
    EXPECT_EQ(problems_of(start + wrong + "\n").size(), 1u) << wrong;
  EXPECT_EQ(problems_of("[fiber]\n[repulsion]\nrange = 7\n").size(), 0u);  // there is none
  EXPECT_EQ(problems_of("[fiber]\n[repulsion]\nstrength = -1\n").size(), 1u);
  EXPECT_EQ(problems_of("[fiber]\n[[repulsion]]\nstrength = 1\n[[repulsion]]\n").size(), 1u);
  // 18 nodes: the spacing is 2 R sin(10 degrees), and sections see others within sqrt(4 R range).
  const auto n_warnings = [](const std::string& range) {
    return read_scene_text("[fiber]\n[repulsion]\nstrength = 1.5\nrange = " + range + "\n", "scene.toml", {})
        .warnings.size();
  };
  EXPECT_EQ(n_warnings("1.5e-4"), 1u);
  EXPECT_EQ(n_warnings("1.52e-4"), 0u);
  EXPECT_EQ(n_warnings("0"), 0u);
}

TEST(SceneOverrides, TakeTomlAndBareWords) {
  const SceneConfig scene = read("[fiber]\n", {"time.method=euler", "time.step=1e-3", "title=a long fiber", "seed=3",
                                               "fiber.center=[0.5, 0, -1]", "flow.kind=\"none\"", "seed=4"});
  EXPECT_EQ(scene.time.method, TimeMethod::euler);
  EXPECT_EQ(scene.time.step, 1e-3);
  EXPECT_EQ(scene.title, "a long fiber");
  EXPECT_EQ(scene.seed, 4u);
  EXPECT_EQ(scene.fibers[0].center, (Vec3{0.5, 0.0, -1.0}));
  ASSERT_EQ(scene.flows.size(), 1u);
  EXPECT_EQ(scene.flows[0].kind, FlowKind::none);
}

TEST(SceneOverrides, HideTheMistakeThatTheyReplace) {
  EXPECT_EQ(problems_of("[fiber]\nblob = -1.0\n").size(), 1u);
  EXPECT_EQ(read("[fiber]\nblob = -1.0\n", {"fiber.blob=0.002"}).fibers[0].blob, 0.002);
}

TEST(SceneOverrides, AreNamedInProblems) {
  EXPECT_EQ(problems_of("[fiber]\n", {"fiber.sections=0", "fiber[1].roll=1.0", "a.b.c=1", "seed=1\nx=2", "=3"}),
            (std::vector<std::string>{
                "--set fiber.sections=0: fiber.sections must be 2 to 1000000000, not 0",
                "--set fiber[1].roll=1.0: there is no fiber[1]: the scene's last is fiber[0]",
                "--set a.b.c=1: write TABLE.KEY=VALUE, as in fiber.sections=113",
                "--set seed=1 x=2: more than one value",
                "--set =3: write TABLE.KEY=VALUE, as in fiber.sections=113",
            }));
}

TEST(SceneWords, StandForOneEnumeratorEach) {
  const Words<TimeMethod>& words = words_of<TimeMethod>();
  EXPECT_EQ(words.choices().size(), 6u);
  for (const Choice& choice : words.choices()) EXPECT_EQ(words.word_of(words.value_of(choice.word)), choice.word);
  EXPECT_EQ(read("[fiber]\n[hydrodynamics]\nprecision = \"single\"\non_miss = \"stop\"\n").hydrodynamics.on_miss,
            OnMiss::stop);
  try {
    words.value_of("rk5");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_error);
    EXPECT_NE(std::string(error.what()).find("\"rk5\" is not known: write \"auto\", \"rkc2\""), std::string::npos);
  }
}

TEST(SceneWords, AreNotWrittenForWhatAKeyCannotBe) {
  SceneConfig scene;
  scene.fibers.resize(1);
  scene.output.precision = Precision::automatic;
  try {
    write_scene(scene);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::internal);
  }
  scene.output.precision = Precision::in_single;
  scene.time.method = static_cast<TimeMethod>(99);
  EXPECT_THROW(write_scene(scene), Error);
}

TEST(SceneProblems, AreAllReportedInTheOrderOfTheFile) {
  EXPECT_EQ(problems_of("[time]\nend = -1.0\n[fluid]\nviscosity = nan\nsed = 3\n[fiber]\nsections = 8.0\n"),
            (std::vector<std::string>{
                "scene.toml:2:7: time.end must be 0 or more, not -1.0",
                "scene.toml:4:13: fluid.viscosity must be a finite number, not nan",
                "scene.toml:5:1: unknown key 'sed' in [fluid]; known are viscosity",
                "scene.toml:7:12: fiber.sections must be an integer, not 8.0",
            }));
}

TEST(SceneProblems, BoundsThemselvesAreAllowed) {
  EXPECT_EQ(problems_of("[fiber]\nsections = 2\nnodes_per_section = 3\nroll = -360\n"), std::vector<std::string>());
  EXPECT_EQ(problems_of("[fiber]\nsections = 1\n").size(), 1u);
  EXPECT_EQ(problems_of("[fiber]\nnodes_per_section = 2\n").size(), 1u);
  EXPECT_EQ(problems_of("[fiber]\nroll = -360.1\n").size(), 1u);
}

TEST(SceneProblems, NodesOfAllFibersAreCounted) {
  const std::string half = "[[fiber]]\nsections = 50000\nnodes_per_section = 1000\n";
  EXPECT_EQ(problems_of(half + half), std::vector<std::string>());
  ASSERT_EQ(problems_of(half + half + "[[fiber]]\n").size(), 1u);
  EXPECT_NE(problems_of(half + half + "[[fiber]]\n")[0].find("nodes"), std::string::npos);
}

TEST(SceneWarnings, ComeWhereTheBlobLeavesItsRange) {
  // Half of the node spacing 2 R sin(pi / 18) is 0.000868241 at R = 0.005.
  const auto n_warnings = [](const std::string& blob) {
    return read_scene_text("[fiber]\nblob = " + blob + "\n", "scene.toml", {}).warnings.size();
  };
  EXPECT_EQ(n_warnings("0.00501"), 1u);
  EXPECT_EQ(n_warnings("0.005"), 0u);
  EXPECT_EQ(n_warnings("0.000869"), 0u);
  EXPECT_EQ(n_warnings("0.000868"), 1u);
}

TEST(NearestName, CountsEdits) {
  EXPECT_EQ(compute_edit_distance("", "blob"), 4);
  EXPECT_EQ(compute_edit_distance("blob", "blob"), 0);
  EXPECT_EQ(compute_edit_distance("blbo", "blob"), 1);  // neighbours swapped
  EXPECT_EQ(compute_edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(compute_edit_distance("sitting", "kitten"), 3);
}

TEST(NearestName, IsGivenOnlyWhereItMayBeMeant) {
  const std::vector<std::string> known{"blob", "roll", "radius", "sections"};
  EXPECT_EQ(find_nearest_name("blobb", known), "blob");
  EXPECT_EQ(find_nearest_name("Radius", known), "radius");
  EXPECT_EQ(find_nearest_name("section", known), "sections");
  EXPECT_EQ(find_nearest_name("temperature", known), "");
  EXPECT_EQ(find_nearest_name("x", known), "");
}

}  // namespace
}  // namespace skein
