#pragma once

#include <skein/scene/scene_config.hpp>

namespace skein::test {

/// A kind of force: its name, and what a scene says to have it. It is the last force of the scene that is made.
struct ForceRow {
  const char* name;
  void (*configure)(SceneConfig& scene);
};

/// Every other fiber, so that tubes stand between chains.
inline void turn_into_chains(SceneConfig& scene, const double bending_rigidity, const double shear_couple) {
  for (std::size_t f = 0; f < scene.fibers.size(); f += 2) {
    FiberConfig& fiber = scene.fibers[f];
    fiber.model = FiberModel::chain;
    fiber.nodes_per_section = 1;
    fiber.spacing = 0.005;
    fiber.bending_rigidity = bending_rigidity;
    fiber.shear_couple = shear_couple;
    fiber.end_couple = 0.01 * shear_couple;
    fiber.stiffness_profile = {{0.2, 1.0}, {0.8, 1.7}};
  }
}

/// Every kind of force: a new one joins the property test and the comparison of thread counts by one row.
inline const ForceRow force_rows[] = {
    {"springs", [](SceneConfig&) {}},
    {"chain_links", [](SceneConfig& scene) { turn_into_chains(scene, 0.0, 0.0); }},
    {"bending", [](SceneConfig& scene) { turn_into_chains(scene, 3e-6, 0.0); }},
    {"shear_couple",
     [](SceneConfig& scene) {
       turn_into_chains(scene, 0.0, 2e-4);
       scene.flows = {{},
                      {.kind = FlowKind::poiseuille, .rate = 1.3, .size = 0.07},
                      {.kind = FlowKind::vortices, .rate = -0.9, .center = {0.01, 0.02, 0.0}, .size = 0.05},
                      {.kind = FlowKind::uniaxial_extension, .rate = 0.7},
                      {.kind = FlowKind::rotation, .rate = 1.1}};
     }},
    {"unsteady_shear_couple",
     [](SceneConfig& scene) {
       turn_into_chains(scene, 0.0, 2e-4);
       if (scene.flows.empty()) scene.flows.emplace_back();
       scene.flows.front().angular_frequency = 3.0;
     }},
    {"repulsion",
     [](SceneConfig& scene) {
       scene.repulsion = {2.3, 0.0071};
     }},
    {"gravity",
     [](SceneConfig& scene) {
       scene.gravity = {1.9, {0.3, -0.5, 0.2}};
     }},
    {"tether",
     [](SceneConfig& scene) {
       scene.tethers = {{0, 2, 1.3, {0.01, 0.02, -0.03}, {0.2, 0.0, 0.1}, {0.0, 0.02, 0.0}, 3.1},
                        {1, -1, 0.7, {0.0, -0.01, 0.02}, {0.0, 0.3, 0.0}, {}, 0.0},
                        {0, 2, 0.4, {}, {}, {0.01, 0.0, 0.0}, 2.0}};
     }},
    {"torque",
     [](SceneConfig& scene) {
       scene.torques = {{0, 3, {0.01, 0.02, -0.03}, {0.5, 0.0, 2.0}},
                        {1, -1, {0.02, 0.0, 0.01}, {}},
                        {0, 3, {0.0, 0.04, 0.0}, {0.0, 0.0, -1.0}}};
     }},
    {"undulation",
     [](SceneConfig& scene) {
       scene.fibers[0].reach_along = 2;
       scene.fibers[0].stiffness_profile = {{0.2, 1.0}, {0.8, 1.7}};
       scene.undulations = {{0, 30.0, 0.03, 3.0, 20.0, 40.0, 0.9, {{0.0, 0.2}, {1.0, 1.0}}},
                            {1, -17.0, 0.0, -2.0, -50.0, 0.0, 0.0},
                            {0, 12.0, 0.05, 5.0, 0.0, 130.0, 0.0}};
     }},
    {"clamp",
     [](SceneConfig& scene) {
       scene.clamps = {
           {0, 2, 1.3, {0.01, 0.02, -0.03}, {0.0, 0.02, 0.01}, {0.3, -0.5, 0.2}, 40.0, {50.0, -20.0, 90.0}, 3.1, 1.7},
           {1, -1, 0.7, {0.0, -0.01, 0.02}, {}, {-1.0, 0.0, 0.0}, 0.0, {}, 0.0, -2.0},
           {0, 2, 0.4, {}, {0.01, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.0, {0.0, 0.0, 30.0}, 2.0}};
     }},
    {"steady_clamp",
     [](SceneConfig& scene) {
       scene.clamps = {{.fiber = 1, .section = 1, .stiffness = 2.0, .tilt = {0.0, 10.0, 0.0}}};
     }},
    {"helix",
     [](SceneConfig& scene) {
       scene.fibers[0].helix_radius = 0.01, scene.fibers[0].helix_pitch = -0.06;
       scene.fibers[0].helix_taper = 0.02, scene.fibers[0].reach_along = 2;
       scene.undulations = {{.fiber = 0, .curvature = 12.0, .wavelength = 0.05, .angular_frequency = 5.0}};
     }},
    {"steady_helix", [](SceneConfig& scene) { scene.fibers[1].helix_radius = 0.01; }},
    {"steady_undulation", [](SceneConfig& scene) { scene.undulations = {{.fiber = 1, .curvature = 25.0}}; }},
};

}  // namespace skein::test
