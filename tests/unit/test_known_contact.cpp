// What is known of contact before a scene has run: of which scenes, and that runs of the cheapest models show it again.
#include "runs/known_contact.hpp"
#include "runs/pilot.hpp"
#include "studies/contact_record.hpp"
#include "studies/paper_scenes.hpp"
#include "studies/rung.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skein {
namespace {

constexpr double long_fiber = 0.931;

SceneConfig make_scene(const double length) { return make_paper_scene(count_paper_sections(length), 20.0); }

/// When surfaces are first inside of each other in a run; infinite: never.
double find_first_inside(const SceneConfig& scene) {
  const Pilot pilot = run_pilot(scene, 400, std::numeric_limits<double>::infinity());
  const double time = record_contact(pilot.analysis).first_inside;
  return std::isnan(time) ? std::numeric_limits<double>::infinity() : time;
}

TEST(KnownContact, IsWhatRunsShow) {
  for (const double length : {0.523, long_fiber}) {
    const SceneConfig scene = make_scene(length);
    int n_rows = 0;
    for (const ContactRow& row : find_known_contacts(scene)) {
      const int rung = row.coarsest;
      if (rung > 4) continue;  // dear
      ++n_rows;
      const double known = row.first_inside / scene.flows[0].rate;
      const double found = find_first_inside(make_rung_scene(scene, rung));
      if (std::isinf(known))
        EXPECT_EQ(found, known) << rung;
      else
        EXPECT_NEAR(found, known, 0.02 * known) << rung;
    }
    EXPECT_GE(n_rows, 2) << length;
  }
}

TEST(KnownContact, IsTheSameInOtherUnitsAndOfRungs) {
  SceneConfig scene = make_scene(long_fiber), other = scene;
  const std::string known = describe_known_contact(scene);
  EXPECT_NE(known.find("pressed into its sides, from t = 13.5 on with a chain, from t = 14.2 on with 4 to 9 nodes"),
            std::string::npos)
      << known;
  EXPECT_NE(known.find("a [repulsion] does"), std::string::npos) << known;
  EXPECT_EQ(describe_known_contact(make_rung_scene(scene, 6)), known);
  constexpr double length = 20.0, time = 0.25, viscosity = 3.0;  // how many of the new units are an old one
  other.fluid.viscosity *= viscosity;
  other.flows[0].rate /= time;
  other.time.end *= time;
  other.fibers[0].radius *= length;
  other.fibers[0].blob *= length;
  other.fibers[0].spring_stiffness *= viscosity * length * length / time;
  const auto rows = find_known_contacts(scene), same = find_known_contacts(other);
  ASSERT_EQ(rows.size(), same.size());
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[i].first_inside, same[i].first_inside);
  EXPECT_NE(describe_known_contact(other).find("from t = 3.38 on with a chain"), std::string::npos);

  scene.time.end = 10.0;
  EXPECT_NE(describe_known_contact(scene).find("this scene ends before"), std::string::npos);
}

TEST(KnownContact, IsOfFibersAloneInSteadyShearOnly) {
  const SceneConfig scene = make_scene(long_fiber);
  const auto expect_unknown = [&](const auto& change) {
    SceneConfig changed = scene;
    change(changed);
    EXPECT_TRUE(find_known_contacts(changed).empty());
    EXPECT_NE(describe_known_contact(changed).find("nothing is known"), std::string::npos);
  };
  expect_unknown([](SceneConfig& s) { s.fibers.push_back(s.fibers[0]); });
  expect_unknown([](SceneConfig& s) { s.flows[0].kind = FlowKind::vortices; });
  expect_unknown([](SceneConfig& s) { s.flows[0].angular_frequency = 1.0; });
  expect_unknown([](SceneConfig& s) { s.flows.push_back(s.flows[0]); });
  expect_unknown([](SceneConfig& s) { s.fibers[0].direction = {0.0, 1.0, 0.0}; });
  expect_unknown([](SceneConfig& s) { s.fibers[0].start_amplitude = 0.1; });
  expect_unknown([](SceneConfig& s) { s.fibers[0].spring_stiffness *= 2.0; });
  expect_unknown([](SceneConfig& s) { s.fibers[0].stiffness_profile = {{0.0, 1.0}, {0.5, 0.2}, {1.0, 1.0}}; });
  expect_unknown([](SceneConfig& s) { s.gravity.weight = 1.0; });
  expect_unknown([](SceneConfig& s) { s.fibers[0].sections = 700; });
}

TEST(KnownContact, OfRigidFibersAndRepulsionsIsSaid) {
  SceneConfig scene = make_scene(long_fiber);
  scene.repulsion.strength = 11.0;
  EXPECT_TRUE(find_known_contacts(scene).empty());
  EXPECT_NE(describe_known_contact(scene).find("[repulsion] keeps surfaces apart if"), std::string::npos);
  scene = make_scene(long_fiber);
  scene.fibers[0].model = FiberModel::rigid;
  EXPECT_NE(describe_known_contact(scene).find("alone touches nothing"), std::string::npos);
}

}  // namespace
}  // namespace skein
