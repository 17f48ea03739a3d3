// What --set changes in a scene: in all instances of a table or in one, in TOML or a bare word, and named where it is
// wrong.

#include "tests/unit/scene_text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace skein {
namespace {

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

TEST(SceneOverrides, NameOneOfSeveralFlows) {
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

TEST(SceneOverrides, MustBeUtf8) {
  for (const char* text : {"title=caf\xe9", "title=\"caf\xe9\"", "t\xc3=1", "flow.kind=\xff", "title=\xed\xa0\x80"}) {
    const auto problems = problems_of("[fiber]\n", {text});
    ASSERT_EQ(problems.size(), 1u) << text;
    EXPECT_EQ(problems[0].find("--set "), 0u) << problems[0];
    EXPECT_NE(problems[0].find("is no UTF-8"), std::string::npos) << problems[0];
  }
  EXPECT_EQ(read("[fiber]\n", {"title=caf\xc3\xa9"}).title, "caf\xc3\xa9");
}

}  // namespace
}  // namespace skein
