#pragma once

#include <skein/scene/scene_config.hpp>

namespace skein::test {

/// A kind of force: its name, and what a scene says to have it. It is the last force of the scene that is made.
struct ForceRow {
  const char* name;
  void (*configure)(SceneConfig& scene);
};

/// Every kind of force: a new one joins the property test and the comparison of thread counts by one row.
inline const ForceRow force_rows[] = {
    {"springs", [](SceneConfig&) {}},
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
};

}  // namespace skein::test
