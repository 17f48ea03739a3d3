// How much a scene makes of small changes: by pilots of the cheapest tube, in scenes whose answer is known.
#include <skein/physics/scene_times.hpp>

#include "studies/ladder_table.hpp"
#include "studies/paper_scenes.hpp"
#include "studies/plan_amplification.hpp"
#include "studies/plan_candidates.hpp"

#include <gtest/gtest.h>

namespace skein {
namespace {

constexpr int cheapest_tube = 4;

SceneConfig make_scene(const FlowKind kind, const double end) {
  SceneConfig scene = make_paper_scene(80, end);
  scene.flows[0].kind = kind;
  return scene;
}

double amplification_of(const SceneConfig& asked) {
  const SceneConfig scene = resolve_times(asked);
  const PlanRequest request;
  const std::function<void(const std::string&)> say = [](const std::string&) {};
  PlanPilots pilots(scene.time.end, request, say);
  const Candidate tube = make_candidate(scene, cheapest_tube);
  const auto pilot = pilots.run(tube.scene, "a tube");
  return measure_amplification(pilots, tube, *pilot);
}

TEST(PlanAmplification, IsAboutOneForAFiberOfTheTable) {
  const double found = amplification_of(make_scene(FlowKind::shear, 12.0));
  EXPECT_GT(found, 0.5);
  EXPECT_LT(found, 3.0);
}

TEST(PlanAmplification, IsLargeWhereCornersOfCellsPartWhatWasNear) {
  SceneConfig scene = make_scene(FlowKind::vortices, 10.0);
  scene.flows[0].rate = -4.0;
  scene.flows[0].size = 0.25;
  scene.fibers[0].center = {0.01, 0.02, 0.0};
  scene.fibers[0].direction = {1.0, 0.1, 0.0};
  scene.fibers[0].start_noise = 1e-3;
  EXPECT_GT(amplification_of(scene), 5.0);
}

TEST(PlanAmplification, IsNoneWhereNothingDependsOnStiffness) {
  SceneConfig scene = make_scene(FlowKind::rotation, 3.0);
  EXPECT_LT(amplification_of(scene), 0.05);
}

TEST(PlanAmplification, OfNoTimeIsNone) {
  const SceneConfig scene = resolve_times(make_scene(FlowKind::shear, 3.0));
  PlanRequest request;
  const std::function<void(const std::string&)> say = [](const std::string&) {};
  const Candidate tube = make_candidate(scene, cheapest_tube);
  const auto pilot = PlanPilots(scene.time.end, request, say).run(tube.scene, "a tube");
  request.max_seconds = 1e-9;
  PlanPilots late(scene.time.end, request, say);
  EXPECT_EQ(measure_amplification(late, tube, *pilot), 0.0);
}

}  // namespace
}  // namespace skein
