// Scenes that lack the symmetry they claim are refused at the key, with what is not symmetric.
#include <skein/core/error.hpp>
#include <skein/fibers/node_orbits.hpp>
#include <skein/physics/physics.hpp>
#include <skein/physics/symmetry_check.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace skein {
namespace {

using enum SymmetryAxis;

/// A fiber along x with 12 nodes on a section, as symmetric as a cuboid, in shear.
SceneConfig make_scene(const SymmetryConfig& symmetry) {
  SceneConfig scene;
  FiberConfig fiber;
  fiber.sections = 20;
  fiber.nodes_per_section = 12;
  scene.fibers = {fiber};
  scene.symmetry = symmetry;
  return scene;
}

struct Case {
  const char* name;
  SymmetryConfig symmetry;
  std::function<void(SceneConfig&)> change;
  const char* words;  ///< of the problem; null: there is none
};

const Case cases[] = {
    {"as it is", {z, z}, [](SceneConfig&) {}, nullptr},
    {"fiber off the plane", {z, none}, [](SceneConfig& s) { s.fibers[0].center.z = 0.01; }, "node 0 of section 0"},
    {"nearly off the plane", {z, none}, [](SceneConfig& s) { s.fibers[0].center.z = 1e-9; }, nullptr},
    {"fiber off the axis", {none, z}, [](SceneConfig& s) { s.fibers[0].center.x = 0.01; }, "fiber 0"},
    {"off an axis that it lies along", {none, x}, [](SceneConfig& s) { s.fibers[0].center.x = 0.3; }, "the flow"},
    {"rolled", {z, none}, [](SceneConfig& s) { s.fibers[0].roll = 10.0; }, "no partner"},
    {"rolled to symmetry", {z, none}, [](SceneConfig& s) { s.fibers[0].roll = 15.0; }, nullptr},
    {"odd number of nodes", {none, z}, [](SceneConfig& s) { s.fibers[0].nodes_per_section = 9; }, "no partner"},
    {"odd number, mirrored", {z, none}, [](SceneConfig& s) { s.fibers[0].nodes_per_section = 9; }, nullptr},
    {"bent evenly",
     {none, z},
     [](SceneConfig& s) { s.fibers[0].start_amplitude = 0.02, s.fibers[0].start_mode = 1; },
     "no partner"},
    {"bent oddly",
     {z, z},
     [](SceneConfig& s) { s.fibers[0].start_amplitude = 0.02, s.fibers[0].start_mode = 2; },
     nullptr},
    {"noise", {z, none}, [](SceneConfig& s) { s.fibers[0].start_noise = 1e-4; }, "no partner"},
    {"profile",
     {none, z},
     [](SceneConfig& s) {
       s.fibers[0].stiffness_profile = {{0.0, 1.0}, {1.0, 2.0}};
     },
     "fiber that is alike"},
    {"even profile",
     {none, z},
     [](SceneConfig& s) {
       s.fibers[0].stiffness_profile = {{0.0, 1.0}, {0.3, 2.0}, {0.7, 2.0}, {1.0, 1.0}};
     },
     nullptr},
    {"other fiber",
     {none, z},
     [](SceneConfig& s) {
       s.fibers.push_back(s.fibers[0]);
       s.fibers[0].center.y = 0.1, s.fibers[1].center.y = -0.1, s.fibers[1].blob = 0.003;
     },
     "fiber that is alike"},
    {"flow along the normal", {x, none}, [](SceneConfig& s) { s.flows[0].kind = FlowKind::shear; }, "the flow, shear"},
    {"flow off the axis", {none, z}, [](SceneConfig& s) { s.flows[0].center.y = 0.1; }, "the flow"},
    {"flows that balance each other",
     {none, z},
     [](SceneConfig& s) {
       s.flows.push_back(s.flows[0]);
       s.flows[0].center.y = 0.1, s.flows[1].center.y = -0.1;
     },
     nullptr},
    {"flows that do so for some time",
     {none, z},
     [](SceneConfig& s) {
       s.flows.push_back(s.flows[0]);
       s.flows[0].center.y = 0.1, s.flows[1].center.y = -0.1, s.flows[1].stop = 1.0;
     },
     "the flow"},
    {"between planes", {z, none}, [](SceneConfig& s) { s.flows[0].kind = FlowKind::poiseuille; }, nullptr},
    {"turned between planes", {none, z}, [](SceneConfig& s) { s.flows[0].kind = FlowKind::poiseuille; }, "the flow"},
    {"vortices about a corner", {z, z}, [](SceneConfig& s) { s.flows[0].kind = FlowKind::vortices; }, nullptr},
    {"vortices shifted by a period",
     {z, z},
     [](SceneConfig& s) {
       s.flows[0].kind = FlowKind::vortices, s.flows[0].center = {1.0, 1.0, 0.2};
     },
     nullptr},
    {"vortices shifted by less",
     {z, z},
     [](SceneConfig& s) {
       s.flows[0].kind = FlowKind::vortices, s.flows[0].center = {0.3, 0.0, 0.0};
     },
     "the flow"},
    {"gravity across the plane", {z, none}, [](SceneConfig& s) { s.gravity.weight = 0.1; }, "gravity"},
    {"gravity in the plane",
     {z, none},
     [](SceneConfig& s) {
       s.gravity = {0.1, {1.0, 2.0, 0.0}};
     },
     nullptr},
    {"gravity in a half turn",
     {none, z},
     [](SceneConfig& s) {
       s.gravity = {0.1, {0.0, -1.0, 0.0}};
     },
     "gravity"},
    {"tether at one end",
     {none, z},
     [](SceneConfig& s) {
       s.tethers = {{.section = 0, .point = {-0.1, 0.0, 0.0}}};
     },
     "tether[0] acts on section 0 of fiber 0"},
    {"tethers at both ends",
     {z, z},
     [](SceneConfig& s) {
       s.tethers = {{.section = 0, .point = {-0.1, 0.2, 0.0}, .swing = {0.0, 0.1, 0.0}, .angular_frequency = 3.0},
                    {.section = -1, .point = {0.1, -0.2, 0.0}, .swing = {0.0, -0.1, 0.0}, .angular_frequency = 3.0}};
     },
     nullptr},
    {"tethers of unlike stiffness",
     {none, z},
     [](SceneConfig& s) {
       s.tethers = {{.section = 0, .point = {-0.1, 0.0, 0.0}},
                    {.section = -1, .stiffness = 2.0, .point = {0.1, 0.0, 0.0}}};
     },
     "tether[0]"},
    {"tether twice and once",
     {none, z},
     [](SceneConfig& s) {
       s.tethers = {{.section = 0, .point = {-0.1, 0.0, 0.0}},
                    {.section = -20, .point = {-0.1, 0.0, 0.0}},
                    {.section = -1, .point = {0.1, 0.0, 0.0}}};
     },
     "tether[0]"},
    {"clamp", {z, none}, [](SceneConfig& s) { s.clamps = {{}}; }, "clamps"},
    {"waves", {z, none}, [](SceneConfig& s) { s.undulations = {{.curvature = 5.0}}; }, "undulate"},
    {"torque about the normal",
     {z, none},
     [](SceneConfig& s) {
       s.torques = {{.section = 3, .torque = {0.0, 0.0, 1e-4}}};
     },
     nullptr},
    {"torque about the plane",
     {z, none},
     [](SceneConfig& s) {
       s.torques = {{.section = 3, .torque = {1e-4, 0.0, 0.0}}};
     },
     "torque[0]"},
    {"torque that turns out of the normal",
     {z, none},
     [](SceneConfig& s) {
       s.torques = {{.section = 3, .torque = {0.0, 0.0, 1e-4}, .angular_velocity = {1.0, 0.0, 0.0}}};
     },
     "torque[0]"},
    {"torques at both ends",
     {none, z},
     [](SceneConfig& s) {
       s.torques = {{.section = 0, .torque = {0.0, 1e-4, 1e-4}}, {.section = -1, .torque = {0.0, -1e-4, 1e-4}}};
     },
     nullptr},
};

TEST(SymmetryCheck, RefusesWhatIsNotSymmetricAndNothingElse) {
  for (const Case& scene_case : cases) {
    SceneConfig scene = make_scene(scene_case.symmetry);
    scene_case.change(scene);
    const auto problems = find_symmetry_problems(scene);
    if (scene_case.words == nullptr) {
      EXPECT_TRUE(problems.empty()) << scene_case.name << ": " << problems[0].message;
      continue;
    }
    ASSERT_FALSE(problems.empty()) << scene_case.name;
    EXPECT_NE(problems[0].message.find(scene_case.words), std::string::npos)
        << scene_case.name << ": " << problems[0].message;
    EXPECT_NE(problems[0].message.find("or leave the key out"), std::string::npos) << problems[0].message;
  }
}

TEST(SymmetryCheck, NamesTheKeyThatIsWrong) {
  SceneConfig scene = make_scene({z, z});
  scene.flows[0].center.y = 0.1;
  const auto problems = find_symmetry_problems(scene);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "symmetry.half_turn");
  scene.fibers[0].center.z = 0.1;
  ASSERT_EQ(find_symmetry_problems(scene).size(), 2u);
  EXPECT_EQ(find_symmetry_problems(scene)[0].key, "symmetry.mirror");
}

// Forces of every kind on symmetric nodes are symmetric: what the rules above promise.
TEST(SymmetryCheck, ForcesOfScenesThatPassAreSymmetric) {
  for (const Case& scene_case : cases) {
    if (scene_case.words != nullptr) continue;
    SceneConfig scene = make_scene(scene_case.symmetry);
    scene.repulsion.strength = 1.0;
    scene_case.change(scene);
    const Physics physics = make_physics(scene);
    const std::vector<Vec3> nodes = physics.make_start_nodes(scene.seed);
    const Vectors position = to_device("test::position", nodes), force("test::force", nodes.size()),
                  projected("test::projected", nodes.size());
    for (const double time : {0.0, 0.37, 2.0}) {
      physics.compute_forces(time, position, force);
      physics.flow->add_velocity(time, position, force);
      Kokkos::deep_copy(projected, force);
      physics.symmetry->project(projected);
      const auto found = to_host(ConstVectors(force)), wanted = to_host(ConstVectors(projected));
      double size = 1e-9;
      for (const Vec3 f : found) size = std::max(size, norm(f));
      for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_LT(norm(found[i] - wanted[i]), 1e-6 * size) << scene_case.name << ", node " << i;
    }
  }
}

// A start that is symmetric but for rounding is made so, and one that is not is refused.
TEST(SymmetryCheck, StartsAreMadeSymmetric) {
  SceneConfig scene = make_scene({z, z});
  scene.fibers[0].direction = {1.0, 0.3, 0.0};
  const Physics physics = make_physics(scene);
  std::vector<Vec3> nodes = physics.make_start_nodes(1);
  const std::vector<Vec3> start = nodes;
  const auto written = make_surface_nodes(physics.fibers);
  for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_LT(norm(nodes[i] - written[i]), 1e-15);
  const double spacing = physics.fibers[0].spacing();
  nodes[100].x += 0.5 * partner_tolerance * spacing;
  make_symmetric(physics.symmetry->orbits(), physics.fibers, nodes);
  nodes[100] = start[100];
  nodes[239].z += 2.0 * partner_tolerance * spacing;
  try {
    make_symmetric(physics.symmetry->orbits(), physics.fibers, nodes);
    FAIL() << "a node is not where its image is";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_error);
    EXPECT_NE(std::string(error.what()).find("node "), std::string::npos);
  }
}

}  // namespace
}  // namespace skein
