#include <skein/physics/spring_forces.hpp>

#include "runs/model_guard.hpp"

#include <gtest/gtest.h>

namespace skein {
namespace {

std::vector<Fiber> make_two_fibers() {
  FiberConfig one, two;
  one.sections = 10;
  two.sections = 7, two.nodes_per_section = 6, two.center = {0.0, 0.3, 0.0}, two.blob = 0.004;
  return make_fibers({one, two});
}

StepRecord make_record(const double gap, const double curvature_one, const double curvature_two) {
  StepRecord record;
  record.step = 12;
  record.time = 0.75;
  record.smallest_gap = gap;
  record.curvature_max = {curvature_one, curvature_two};
  return record;
}

TEST(ModelGuard, IsSilentWithinTheModel) {
  const auto fibers = make_two_fibers();
  ModelGuard guard(fibers);
  EXPECT_TRUE(guard.look(make_record(0.0041, 0.99 / fibers[0].spacing(), 0.99 / fibers[1].spacing()), 0.49).empty());
  EXPECT_EQ(guard.describe(), "");
}

TEST(ModelGuard, TellsEachKindOnceWithItsNumbersAndCountsSteps) {
  const auto fibers = make_two_fibers();
  ModelGuard guard(fibers);
  const auto news = guard.look(make_record(0.0039, 0.0, 1.25 / fibers[1].spacing()), 0.62);
  ASSERT_EQ(news.size(), 3u);
  for (const std::string& sentence : news) EXPECT_NE(sentence.find("t = 0.75, step 12"), std::string::npos) << sentence;
  EXPECT_NE(news[0].find("fiber 1 is bent to a radius of 0.004, less than the distance of its sections, 0.005"),
            std::string::npos)
      << news[0];
  EXPECT_NE(news[1].find("62 %"), std::string::npos) << news[1];
  EXPECT_NE(news[2].find("0.0039 apart, less than a blob, 0.004; no number of nodes keeps surfaces apart"),
            std::string::npos)
      << news[2];
  ModelGuard with_repulsion(fibers, true);
  const auto weak = with_repulsion.look(make_record(0.0039, 0.0, 0.0), 0.0);
  ASSERT_EQ(weak.size(), 1u);
  EXPECT_NE(weak[0].find("take a larger repulsion.strength"), std::string::npos) << weak[0];

  EXPECT_TRUE(guard.look(make_record(-0.002, 0.0, 2.0 / fibers[1].spacing()), 0.71).empty());
  EXPECT_TRUE(guard.look(make_record(0.001, 0.0, 0.0), 0.3).empty());
  EXPECT_EQ(
      guard.describe(),
      "beyond what the model resolves: 2 steps with bends down to 0.5 of the sections' distance; 2 steps with "
      "springs strained by up to 71 %; 3 steps with gaps down to -0.5 blobs; no centreline passed through another");
}

TEST(ModelGuard, OfChainsTellsOfGapsBelowARadius) {
  FiberConfig chain;
  chain.model = FiberModel::chain;
  chain.nodes_per_section = 1;
  chain.radius = 0.005;
  chain.blob = 0.0101;  // which stands for the radius
  ModelGuard guard(make_fibers({chain, chain}));
  EXPECT_TRUE(guard.look(make_record(0.0051, 0.0, 0.0), 0.0).empty());
  const auto news = guard.look(make_record(-0.001, 0.0, 0.0), 0.0);
  ASSERT_EQ(news.size(), 1u);
  EXPECT_NE(news[0].find("-0.001 apart, less than a radius, 0.005"), std::string::npos) << news[0];
  EXPECT_NE(guard.describe().find("gaps down to -0.2 radii"), std::string::npos) << guard.describe();
}

TEST(ModelGuard, TellsOfNodesInsideAndOfCentrelinesThatCross) {
  ModelGuard guard(make_two_fibers());
  StepRecord record = make_record(-0.001, 0.0, 0.0);
  record.nodes_inside = 3;
  record.depth = 0.0012;
  auto news = guard.look(record, 0.0);
  ASSERT_EQ(news.size(), 2u);
  EXPECT_NE(news[1].find("3 nodes are inside of another surface, the deepest by 0.0012; the blob is 0.004"),
            std::string::npos)
      << news[1];
  record.nodes_inside = 7;
  record.depth = 0.0008;
  record.crossings = 1;
  news = guard.look(record, 0.0);
  ASSERT_EQ(news.size(), 1u);
  EXPECT_NE(news[0].find("centrelines have passed through each other"), std::string::npos) << news[0];
  EXPECT_TRUE(guard.look(record, 0.0).empty());
  record.crossings = 4;
  EXPECT_TRUE(guard.look(record, 0.0).empty());
  EXPECT_EQ(
      guard.describe(),
      "beyond what the model resolves: 4 steps with gaps down to -0.25 blobs; 4 steps with nodes inside of another "
      "surface, up to 7 of them, 0.3 blobs deep; 2 steps with centrelines that pass through each other, 4 times in "
      "all");
}

TEST(SpringForces, LargestStrainIsThatOfTheMostStrainedSpring) {
  const auto fibers = make_two_fibers();
  const SpringForces springs(fibers);
  auto position = make_surface_nodes(fibers);
  EXPECT_LT(springs.compute_largest_strain(to_device("position", position)), 1e-13);
  for (Vec3& x : position) x = 1.25 * x;
  EXPECT_NEAR(springs.compute_largest_strain(to_device("position", position)), 0.25, 1e-13);
  for (Vec3& x : position) x = 0.2 * x;
  EXPECT_NEAR(springs.compute_largest_strain(to_device("position", position)), 0.75, 1e-13);
}

}  // namespace
}  // namespace skein
