#pragma once

#include <skein/core/counter_random.hpp>
#include <skein/fibers/node_orbits.hpp>
#include <skein/physics/node_symmetry.hpp>
#include <skein/physics/symmetric_mobility.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace skein {

// Symmetric fibers that are not straight any more, with symmetric forces: for tests of what sums over images.

struct SymmetricCase {
  std::string name;
  SymmetryConfig symmetry;
  std::vector<FiberConfig> fibers;
};

inline FiberConfig make_tube(const int sections, const int nodes_per_section, const Vec3 direction,
                             const Vec3 center = {}) {
  FiberConfig fiber;
  fiber.sections = sections;
  fiber.nodes_per_section = nodes_per_section;
  fiber.direction = direction;
  fiber.center = center;
  return fiber;
}

inline FiberConfig make_bare_chain(const int n_nodes, const Vec3 direction) {
  FiberConfig fiber = make_tube(n_nodes, 1, direction);
  fiber.model = FiberModel::chain;
  fiber.spacing = 0.01;
  fiber.blob = 0.01;
  return fiber;
}

/// Every kind of group, fibers that are each other's images, nodes on the plane, on the axis and at the origin, and
/// numbers of nodes about the edges of tiles.
inline std::vector<SymmetricCase> list_symmetric_cases() {
  using enum SymmetryAxis;
  const Vec3 oblique{1.0, 0.5, 0.0};
  std::vector<SymmetricCase> cases;
  for (const int sections : {15, 24, 48, 49, 77}) {
    cases.push_back({"mirror", {z, none}, {make_tube(sections, 18, oblique)}});
    cases.push_back({"half turn", {none, z}, {make_tube(sections, 12, oblique)}});
    cases.push_back({"both", {z, z}, {make_tube(sections, 18, oblique)}});
    cases.push_back({"both, few nodes", {z, z}, {make_tube(sections, 4, oblique)}});
    cases.push_back({"mixed axes", {y, z}, {make_tube(sections, 12, {1.0, 0.0, 0.0})}});
  }
  cases.push_back({"axis along the fiber", {none, x}, {make_tube(40, 18, {1.0, 0.0, 0.0})}});
  cases.push_back({"axis across the plane's normal", {z, y}, {make_tube(41, 8, {1.0, 0.0, 0.0})}});
  cases.push_back(
      {"images of each other",
       {none, x},
       {make_tube(30, 18, {1.0, 0.7, 0.0}, {0.0, 0.0, 0.02}), make_tube(30, 18, {1.0, -0.7, 0.0}, {0.0, 0.0, -0.02})}});
  cases.push_back(
      {"images of each other, both ways round",
       {y, z},
       {make_tube(21, 12, oblique, {0.1, 0.1, 0.0}), make_tube(21, 12, oblique, {-0.1, -0.1, 0.0}),
        make_tube(21, 12, {1.0, -0.5, 0.0}, {0.1, -0.1, 0.0}), make_tube(21, 12, {1.0, -0.5, 0.0}, {-0.1, 0.1, 0.0})}});
  FiberConfig thick = make_tube(33, 12, {1.0, 0.0, 0.0});
  thick.blob = 0.004;
  cases.push_back({"unlike blobs",
                   {z, z},
                   {thick, make_tube(20, 12, {1.0, 0.0, 0.0}, {0.0, 0.1, 0.0}),
                    make_tube(20, 12, {1.0, 0.0, 0.0}, {0.0, -0.1, 0.0})}});
  cases.push_back({"chain, all nodes on the plane", {z, z}, {make_bare_chain(301, oblique)}});
  cases.push_back({"chain, half turn", {none, z}, {make_bare_chain(300, oblique)}});
  cases.push_back({"few nodes", {z, z}, {make_tube(5, 4, oblique)}});
  return cases;
}

/// Vectors on nodes that are images of each other to the last bit. @param random  its draws from `first_draw` on
inline std::vector<Vec3> make_symmetric_vectors(const NodeOrbits& orbits, const CounterRandom& random,
                                                const std::uint64_t first_draw, const double size) {
  std::vector<Vec3> vectors(static_cast<std::size_t>(orbits.n_nodes));
  std::uint64_t draw = first_draw;
  for (const OrbitClass& run : orbits.classes)
    for (int orbit = run.first; orbit < run.first + run.count; ++orbit) {
      const auto [a, b] = random.draw(draw++);
      const double c = random.draw(draw++)[0];
      const Vec3 v =
          without_components(find_vanishing(run.stabilizer), size * Vec3{2.0 * a - 1.0, 2.0 * b - 1.0, 2.0 * c - 1.0});
      for (std::size_t element = 0; element < orbits.group.size(); ++element)
        if (const int node = orbits.image_of(orbit, static_cast<int>(element)); node >= 0)
          vectors[static_cast<std::size_t>(node)] = orbits.group[element] * v;
    }
  return vectors;
}

/// A case's nodes, moved, and forces on them.
struct SymmetricSources {
  explicit SymmetricSources(const SymmetricCase& scene) {
    const std::vector<Fiber> fibers = make_fibers(scene.fibers);
    nodes = make_surface_nodes(fibers);
    symmetry = std::make_shared<const NodeSymmetry>(make_node_orbits(scene.symmetry, fibers, nodes));
    const NodeOrbits& orbits = symmetry->orbits();
    make_symmetric(orbits, fibers, nodes);
    const CounterRandom random(7, CounterRandom::Purpose::start_noise, 0);
    const auto moves = make_symmetric_vectors(orbits, random, 0, 0.2 * fibers[0].spacing());
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = nodes[i] + moves[i];
    sources = {to_device("test::position", nodes),
               to_device("test::force", make_symmetric_vectors(orbits, random, 1u << 20, 0.03)),
               to_device("test::blob", make_blobs(fibers))};
  }

  std::vector<Vec3> compute(Mobility& mobility) const {
    const Vectors velocity("test::velocity", nodes.size());
    mobility.add_velocity(sources, sources.position, velocity);
    return to_host(ConstVectors(velocity));
  }

  std::vector<Vec3> nodes;
  std::shared_ptr<const NodeSymmetry> symmetry;
  Sources sources;
};

}  // namespace skein
