// What is wrong with a scene, or suspicious, in one key or in several together.

#include "tests/support/nan_trap.hpp"
#include "tests/unit/scene_text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace skein {
namespace {

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

TEST(SceneProblems, AProfileIsPairsInOrder) {
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

TEST(SceneProblems, AGridIsMadeOfWholeNumbersAndItsNodesAreCounted) {
  const std::string fiber = "[fiber]\nsections = 100\nnodes_per_section = 1000\n[placement]\nkind = \"grid\"\n";
  EXPECT_EQ(problems_of(fiber + "grid = [1.5, 1, 1]\n").size(), 1u);
  EXPECT_EQ(problems_of(fiber + "grid = [10, 10, 10]\n").size(), 0u);
  EXPECT_EQ(problems_of(fiber + "grid = [10, 10, 11]\n").size(), 1u);
  EXPECT_EQ(problems_of("[fiber]\n[placement]\nkind = \"grid\"\ngrid = [100, 101, 1]\n").size(), 1u);
}

TEST(SceneProblems, ARepulsionFitsTheThinnestFiber) {
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
    return count_warnings("[fiber]\n[repulsion]\nstrength = 1.5\nrange = " + range + "\n");
  };
  EXPECT_EQ(n_warnings("1.5e-4"), 1u);
  EXPECT_EQ(n_warnings("1.52e-4"), 0u);
  EXPECT_EQ(n_warnings("0"), 0u);
}

TEST(SceneWarnings, ComeWhereTheBlobLeavesItsRange) {
  // Half of the node spacing 2 R sin(pi / 18) is 0.000868241 at R = 0.005.
  const auto n_warnings = [](const std::string& blob) { return count_warnings("[fiber]\nblob = " + blob + "\n"); };
  EXPECT_EQ(n_warnings("0.00501"), 1u);
  EXPECT_EQ(n_warnings("0.005"), 0u);
  EXPECT_EQ(n_warnings("0.000869"), 0u);
  EXPECT_EQ(n_warnings("0.000868"), 1u);
}

}  // namespace
}  // namespace skein
