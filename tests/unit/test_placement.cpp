#include <skein/core/error.hpp>
#include <skein/fibers/placement.hpp>
#include <skein/fibers/segment_distance.hpp>

#include "tests/reference/point_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace skein {
namespace {

SceneConfig make_scene(const PlacementKind kind) {
  SceneConfig scene;
  scene.seed = 4;
  scene.fibers.resize(1);
  scene.fibers[0].sections = 20;
  scene.placement.kind = kind;
  return scene;
}

std::string error_of(const auto& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_error);
    return error.what();
  }
  return "";
}

TEST(SegmentDistance, IsTheSmallestOverAllPairsOfPoints) {
  reference::Random random(3);
  for (int trial = 0; trial < 30; ++trial) {
    const Vec3 a = random.in_cube(1), b = random.in_cube(1), c = random.in_cube(1);
    const Vec3 d = trial % 3 == 0 ? c + 0.7 * (b - a) : random.in_cube(1);  // parallel ones, too
    double smallest = 10.0;
    constexpr int n = 400;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        smallest = std::min(smallest, norm(a + i / double(n) * (b - a) - c - j / double(n) * (d - c)));
    const double found = compute_segment_distance(a, b, c, d);
    EXPECT_LE(found, smallest + 1e-12);
    EXPECT_NEAR(found, smallest, 0.01);
  }
  EXPECT_EQ(compute_segment_distance({1, 0, 0}, {1, 0, 0}, {1, 2, 0}, {1, 2, 0}), 2.0);
  EXPECT_NEAR(compute_segment_distance({-1, 0, 0.5}, {1, 0, 0.5}, {0, -1, 0}, {0, 1, 0}), 0.5, 1e-15);
}

TEST(Placement, AsWrittenChangesNothing) {
  const SceneConfig scene = make_scene(PlacementKind::as_written);
  EXPECT_EQ(place_fibers(scene).fibers.size(), 1u);
}

TEST(Placement, AGridIsCentredAndTakesTheFibersInTurn) {
  SceneConfig scene = make_scene(PlacementKind::grid);
  scene.fibers.resize(2);
  scene.fibers[1].sections = 30;
  scene.placement.grid = {3, 2, 1};
  scene.placement.spacing = {0.5, 0.25, 7.0};
  scene.placement.center = {1.0, 2.0, 3.0};
  const SceneConfig placed = place_fibers(scene);
  EXPECT_EQ(placed.placement.kind, PlacementKind::as_written);
  ASSERT_EQ(placed.fibers.size(), 6u);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(placed.fibers[i].center, (Vec3{0.5 + 0.5 * (i % 3), i < 3 ? 1.875 : 2.125, 3.0})) << i;
    EXPECT_EQ(placed.fibers[i].sections, i % 2 == 0 ? 20 : 30);
    EXPECT_EQ(placed.fibers[i].direction, (Vec3{1, 0, 0}));
  }
}

TEST(Placement, RandomFibersAreInTheBoxAndDoNotTouch) {
  SceneConfig scene = make_scene(PlacementKind::random);
  scene.placement.count = 24;
  scene.placement.box = {0.08, 0.1, 0.07};
  scene.placement.center = {1.0, -1.0, 0.5};
  scene.placement.gap = 0.003;
  scene.placement.orientation = Orientation::random;
  const SceneConfig placed = place_fibers(scene);
  ASSERT_EQ(placed.fibers.size(), 24u);
  const auto fibers = make_fibers(placed.fibers);
  EXPECT_TRUE(find_overlap_problems(scene, fibers).empty());
  double nearest = 1.0;
  Vec3 mean_square;
  for (const Fiber& a : fibers) {
    for (const Vec3 x : make_surface_nodes({a})) {
      EXPECT_LE(std::abs(x.x - 1.0), 0.04);
      EXPECT_LE(std::abs(x.y + 1.0), 0.05);
      EXPECT_LE(std::abs(x.z - 0.5), 0.035);
    }
    const Vec3 d = a.config.direction;
    mean_square = mean_square + Vec3{d.x * d.x, d.y * d.y, d.z * d.z} / 24.0;
    for (int j = 0; j < a.index; ++j)
      for (const Vec3 x : make_surface_nodes({a}))
        for (const Vec3 y : make_surface_nodes({fibers[j]})) nearest = std::min(nearest, norm(x - y));
  }
  EXPECT_GE(nearest, 0.003);
  EXPECT_LT(nearest, 0.01);  // it is crowded
  for (const double share : {mean_square.x, mean_square.y, mean_square.z}) EXPECT_NEAR(share, 1.0 / 3.0, 0.18);
}

TEST(Placement, FollowsFromTheSeed) {
  SceneConfig scene = make_scene(PlacementKind::random);
  const auto centers = [&scene] {
    std::vector<Vec3> list;
    for (const FiberConfig& fiber : place_fibers(scene).fibers) list.push_back(fiber.center);
    return list;
  };
  const auto first = centers();
  EXPECT_EQ(centers(), first);
  scene.placement.count = 12;
  const auto more = centers();
  EXPECT_TRUE(std::equal(first.begin(), first.end(), more.begin()));
  scene.seed = 5;
  EXPECT_NE(centers()[0], first[0]);
}

TEST(Placement, AFullBoxIsAnErrorWithNumbers) {
  SceneConfig scene = make_scene(PlacementKind::random);
  scene.placement.box = {0.05, 0.05, 0.05};
  scene.placement.count = 200;
  const std::string crowded = error_of([&] { place_fibers(scene); });
  EXPECT_NE(crowded.find("of 200 random fibers fit into the box 0.05 x 0.05 x 0.05"), std::string::npos) << crowded;
  scene.placement.box = {0.02, 1.0, 1.0};  // shorter than a fiber
  EXPECT_NE(error_of([&] { place_fibers(scene); }).find("0 of 200"), std::string::npos);
}

TEST(Overlap, IsFoundBetweenStraightAndBentFibers) {
  SceneConfig scene;
  scene.fibers.resize(2);
  FiberConfig &first = scene.fibers[0], &second = scene.fibers[1];
  const auto problems = [&] { return find_overlap_problems(scene, make_fibers(scene.fibers)); };
  second.direction = {0, 0, 1};
  second.center = {0.02, 0.0100001, 0};  // radii 0.005
  EXPECT_EQ(problems().size(), 0u);
  second.center.y = 0.0099999;
  ASSERT_EQ(problems().size(), 1u);
  EXPECT_EQ(problems()[0].key, "fiber[1].center");
  const std::string message = problems()[0].message;
  EXPECT_NE(message.find("fibers 0 and 1"), std::string::npos) << message;
  EXPECT_NE(message.find("0.01."), std::string::npos) << message;

  // A bend of 0.1 L = 0.0139 reaches the other fiber, one away from it does not.
  second.center.y = 0.012;
  first.start_amplitude = 0.1;
  const auto with_plane = [&](const double plane) {
    first.start_plane = plane;
    return problems().size();
  };
  EXPECT_EQ(with_plane(0.0), 1u);
  EXPECT_EQ(with_plane(180.0), 0u);
}

TEST(Overlap, IsToldOnceForEachFiberAndOnceForAGrid) {
  SceneConfig scene;
  scene.fibers.resize(5);
  scene.fibers[3].center = {0.0, 0.0, 0.02};  // the others are in one place
  const auto found = find_overlap_problems(scene, make_fibers(scene.fibers));
  ASSERT_EQ(found.size(), 3u);
  const int fiber[] = {1, 2, 4};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(found[i].key, "fiber[" + std::to_string(fiber[i]) + "].center");
    EXPECT_EQ(found[i].message.find("fibers 0 and " + std::to_string(fiber[i])), 0u) << found[i].message;
  }
  scene.placement.kind = PlacementKind::grid;
  scene.placement.grid = {1, 4, 3};
  scene.placement.spacing = {1.0, 0.02, 0.0099};
  const auto of_grid = find_overlap_problems(scene, make_fibers(place_fibers(scene).fibers));
  ASSERT_EQ(of_grid.size(), 1u);
  EXPECT_EQ(of_grid[0].key, "placement.spacing");
  EXPECT_EQ(of_grid[0].message.find("fibers 0 and 4"), 0u) << of_grid[0].message;
}

}  // namespace
}  // namespace skein
