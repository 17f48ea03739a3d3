#pragma once

#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/physics/shared_nodes.hpp>
#include <skein/physics/sum_team.hpp>

#include "tests/support/rank_team.hpp"

#include <cstring>
#include <random>

// Nodes that ranks own, and whole arrays beside them.

namespace skein::test {

using Nodes = std::vector<Vec3>;

inline Nodes make_noise(const int n, const unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Nodes nodes(static_cast<std::size_t>(n));
  for (Vec3& v : nodes) v = {uniform(random), uniform(random), uniform(random)};
  return nodes;
}

inline bool is_same(const Nodes& a, const Nodes& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}
inline bool is_same(const double a, const double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

inline Nodes read(const ConstVectors& vectors) { return to_host(vectors); }

/// Sections of 9 and 5 nodes, so that no edge between ranks is one of a chunk of a dot product.
inline SceneConfig make_scene(const int sections, const SumMethod sums = SumMethod::direct) {
  SceneConfig scene;
  FiberConfig thick, thin;
  thick.sections = thin.sections = sections;
  thick.nodes_per_section = 9;
  thin.nodes_per_section = 5;
  thick.start_amplitude = thin.start_amplitude = 0.02;
  thick.direction = {1.0, 0.4, 0.1};
  thin.direction = {1.0, 0.5, 0.0};
  thin.center = {0.0, 0.0, 0.03};
  thick.blob = thin.blob = 0.0045;
  scene.fibers = {thick, thin};
  scene.flows.emplace_back().rate = 2.5;
  scene.hydrodynamics.method = sums;
  scene.hydrodynamics.tolerance = 1e-3;
  scene.hydrodynamics.check_every = 7;
  return scene;
}

/// Physics that ranks share, and arrays of both kinds.
struct Case {
  Physics physics;
  FiberDynamics dynamics{physics};
  int n_nodes = count_nodes(physics.fibers);

  explicit Case(const SceneConfig& scene) : physics(make_physics(scene, find_team())) {}
  NodeVectors& parts() { return *physics.shared_nodes; }
  Vectors part_of(const Nodes& nodes) {
    const Vectors part = parts().make("part", n_nodes);
    parts().scatter(to_device("whole", nodes), part);
    return part;
  }
  Nodes whole_of(const Vectors& part) { return read(parts().gather(part)); }
};

}  // namespace skein::test
