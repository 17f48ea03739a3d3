// Tubes of other numbers of nodes: what is kept, what is fitted, and what goes along with it.
#include <skein/core/error.hpp>
#include <skein/fibers/calibration.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/physics/rigid_tube.hpp>

#include "studies/ladder_table.hpp"
#include "studies/paper_scenes.hpp"
#include "studies/rung.hpp"
#include "studies/rung_name.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace skein {
namespace {

double relative_stiffness(const FiberConfig& a, const FiberConfig& b) {
  return measure_beam_stiffness(make_fibers({a})[0]).relaxed_bending /
         measure_beam_stiffness(make_fibers({b})[0]).relaxed_bending;
}

TEST(Rung, KeepsLengthRadiusAndHowTheFluidTurnsAndBendsIt) {
  for (const int sections : {30, 80, 113, 301}) {
    const FiberConfig fine = make_paper_scene(sections, 30.0).fibers[0];
    const RigidTubeDrag drag = measure_rigid_tube(make_fibers({fine})[0], 1.0);
    for (const int nodes : {4, 5, 6, 9, 12, 24}) {
      const RungFit fit = fit_rung(fine, nodes);
      const Fiber rung = make_fibers({fit.fiber})[0];
      EXPECT_EQ(rung.config.nodes_per_section, nodes);
      EXPECT_EQ(rung.config.radius, fine.radius);
      EXPECT_NEAR(rung.length(), make_fibers({fine})[0].length(), 1e-12);
      EXPECT_LT(std::abs(fit.aspect_ratio_error), 1e-5);
      if (sections >= 80 && nodes <= 12) {
        EXPECT_GT(fit.fiber.blob, fine.blob) << nodes;
      }
      // Of the whole fiber, not the piece that was fitted; the coarser tube ends earlier by half a spacing.
      const RigidTubeDrag found = measure_rigid_tube(rung, 1.0);
      if (sections >= 80) {
        EXPECT_NEAR(found.effective_aspect_ratio() / drag.effective_aspect_ratio(), 1.0, 0.02) << nodes;
        EXPECT_NEAR(found.transverse / drag.transverse, 1.0, 0.04) << nodes;
      }
      // What a flow bends it with grows with the drag.
      EXPECT_NEAR(relative_stiffness(fit.fiber, fine) / (found.turning / drag.turning), 1.0,
                  sections > 300 ? 0.01 : 1e-3)
          << nodes;
    }
  }
}

TEST(Rung, OfTheSameNumberOfNodesIsTheFiberItself) {
  const FiberConfig fine = make_paper_scene(80, 30.0).fibers[0];
  EXPECT_EQ(fit_rung(fine, 18).fiber, fine);
}

TEST(Rung, NeedsNoUnits) {
  FiberConfig fine = make_paper_scene(80, 30.0).fibers[0];
  const FiberConfig coarse = fit_rung(fine, 6).fiber;
  constexpr double length = 1e-6, force = 1e-9;
  fine.radius *= length;
  fine.blob *= length;
  fine.spring_stiffness *= force;
  const FiberConfig scaled = fit_rung(fine, 6).fiber;
  EXPECT_EQ(scaled.sections, coarse.sections);
  EXPECT_NEAR(scaled.blob / length, coarse.blob, 1e-9 * coarse.blob);
  EXPECT_NEAR(scaled.spring_stiffness / force, coarse.spring_stiffness, 1e-9 * coarse.spring_stiffness);
}

TEST(Rung, OfASceneHoldsAndTurnsTheSamePlaces) {
  SceneConfig scene = make_paper_scene(101, 30.0);
  scene.fibers.push_back(scene.fibers[0]);
  scene.fibers[1].center = {0.0, 0.2, 0.0};
  scene.fibers[1].sections = 51;
  scene.tethers.push_back({0, 50});
  scene.tethers.push_back({1, -1});
  scene.torques.push_back({1, 0});
  scene.torques.push_back({0, -26});
  const SceneConfig rung = make_rung_scene(scene, 6);
  const int last = rung.fibers[0].sections - 1;
  EXPECT_EQ(rung.tethers[0].section, static_cast<int>(std::lround(0.5 * last)));
  EXPECT_EQ(rung.tethers[1].section, -1);
  EXPECT_EQ(rung.torques[0].section, 0);
  EXPECT_EQ(rung.torques[1].section, -1 - static_cast<int>(std::lround(0.25 * last)));
  EXPECT_EQ(rung.fibers[1].center.y, 0.2);
  EXPECT_LT(rung.fibers[1].sections, rung.fibers[0].sections);
}

TEST(Rung, BelowTheChainIsRigidAndHeldAtTheSamePlaces) {
  SceneConfig scene = make_paper_scene(101, 30.0);
  scene.tethers = {{0, 50}, {0, -1}};
  const SceneConfig chain = make_rung_scene(scene, chain_rung);
  SceneConfig rigid = make_rung_scene(scene, rigid_rung);
  EXPECT_TRUE(rigid.fibers[0].is_rigid());
  EXPECT_EQ(find_rung(rigid.fibers[0]), rigid_rung);
  rigid.fibers[0].model = FiberModel::chain;
  EXPECT_EQ(rigid, chain);
}

TEST(Rung, SaysWhatBarsRigidFibers) {
  const SceneConfig straight = make_paper_scene(101, 30.0);
  EXPECT_EQ(find_bar_to_rigid(straight), "");
  for (double FiberConfig::*const key : {&FiberConfig::start_amplitude, &FiberConfig::start_noise}) {
    SceneConfig bent = straight;
    bent.fibers[0].*key = 0.01;
    EXPECT_NE(find_bar_to_rigid(bent).find("bent"), std::string::npos);
  }
  SceneConfig other = straight;
  other.torques.push_back({0, 0});
  EXPECT_NE(find_bar_to_rigid(other).find("torque"), std::string::npos);
  other = straight;
  other.undulations.push_back({});
  EXPECT_NE(find_bar_to_rigid(other).find("undulate"), std::string::npos);
  other = straight;
  other.time.method = TimeMethod::trbdf2;
  EXPECT_NE(find_bar_to_rigid(other).find("trbdf2"), std::string::npos);
}

TEST(Rung, IsRefusedWhereNoBlobServes) {
  FiberConfig thick = make_paper_scene(20, 30.0).fibers[0];
  thick.blob = 0.0049;
  thick.nodes_per_section = 3;
  EXPECT_THROW(fit_rung(thick, 48), Error);
}

TEST(LadderTable, ExtrapolatesDifferencesOfErrorsThatFallWithTheSquare) {
  const auto answer = [](const int nodes) { return 3.0 - 0.7 / (1.0 * nodes * nodes); };
  for (const auto& [coarse, fine] : std::vector<std::pair<int, int>>{{4, 5}, {4, 24}, {5, 12}, {18, 24}})
    EXPECT_NEAR(extrapolate_difference(coarse, fine, answer(fine) - answer(coarse)),
                answer(finest_rung) - answer(coarse), 1e-14)
        << coarse << " " << fine;
  EXPECT_EQ(extrapolate_difference(chain_rung, 4, 0.25), 0.25);
  EXPECT_EQ(extrapolate_difference(9, 30, 0.25), 0.25);  // finer than what errors are told against
}

}  // namespace
}  // namespace skein
