#include <skein/core/error.hpp>
#include <skein/fibers/node_orbits.hpp>
#include <skein/scene/words.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace skein {
namespace {

unsigned bit_of(const SymmetryAxis axis) {
  switch (axis) {
    case SymmetryAxis::none:
      return 0u;
    case SymmetryAxis::x:
      return 1u;
    case SymmetryAxis::y:
      return 2u;
    case SymmetryAxis::z:
      return 4u;
  }
  throw Error(ExitCode::internal, "bit_of knows no such axis");
}

/// The map of an element that is an earlier one times a generator.
std::vector<int> compose_map(const std::vector<SignMatrix>& group, const std::vector<std::vector<int>>& of_earlier,
                             const std::vector<SignMatrix>& generators, const std::vector<std::vector<int>>& maps) {
  const SignMatrix wanted = group[of_earlier.size()];
  for (std::size_t e = 0; e < of_earlier.size(); ++e)
    for (std::size_t g = 0; g < generators.size(); ++g) {
      if (!(group[e] * generators[g] == wanted)) continue;
      std::vector<int> both;
      for (const int node : maps[g]) both.push_back(of_earlier[e][static_cast<std::size_t>(node)]);
      return both;
    }
  throw Error(ExitCode::internal, "the group has an element that no generator makes of those before it");
}

/// One orbit: the images of a node that is the first of them.
struct Orbit {
  std::vector<int> image;              ///< of each element; -1 where it is one of before
  std::vector<SignMatrix> stabilizer;  ///< what keeps the node in place
};

Orbit make_orbit(const std::vector<SignMatrix>& group, const std::vector<std::vector<int>>& maps, const int node) {
  Orbit orbit;
  for (std::size_t e = 0; e < group.size(); ++e) {
    const int image = maps[e][static_cast<std::size_t>(node)];
    if (image == node) orbit.stabilizer.push_back(group[e]);
    const bool is_known = std::find(orbit.image.begin(), orbit.image.end(), image) != orbit.image.end();
    orbit.image.push_back(is_known ? -1 : image);
  }
  return orbit;
}

}  // namespace

SignMatrix make_mirror(const SymmetryAxis normal) { return {bit_of(normal)}; }

SignMatrix make_half_turn(const SymmetryAxis axis) {
  constexpr unsigned all = 7u;
  return {axis == SymmetryAxis::none ? 0u : all & ~bit_of(axis)};
}

std::string describe_symmetry(const SymmetryConfig& symmetry) {
  std::string text;
  if (symmetry.mirror != SymmetryAxis::none) text = fmt::format("in the plane {} = 0", word_of(symmetry.mirror));
  if (symmetry.half_turn != SymmetryAxis::none)
    text += fmt::format("{}under a half turn about {}", text.empty() ? "" : " and ", word_of(symmetry.half_turn));
  return text;
}

double NodeOrbits::gain() const {
  const double n = n_nodes;
  return n_nodes == 0 ? 1.0 : n * n / count_image_pairs(group, classes);
}

std::string NodeOrbits::describe_images() const {
  return fmt::format("by {} of {} nodes and their images, {:.3g} times fewer pairs", n_orbits(), n_nodes, gain());
}

std::string NodeOrbits::describe_targets() const {
  return fmt::format("for {} of {} nodes, of which all others are images", n_orbits(), n_nodes);
}

NodeOrbits make_node_orbits(const SymmetryConfig& symmetry, const std::vector<Fiber>& fibers,
                            const std::vector<Vec3>& nodes) {
  const std::vector<SignMatrix> generators{make_mirror(symmetry.mirror), make_half_turn(symmetry.half_turn)};
  std::vector<std::vector<int>> maps;
  for (const SignMatrix generator : generators) {
    NodeMap map = find_node_map(fibers, nodes, generator);
    if (!map.fault.empty()) throw Error(ExitCode::scene_error, "the scene lacks its [symmetry]: " + map.fault);
    maps.push_back(std::move(map.image));
  }
  NodeOrbits orbits;
  orbits.group = make_group(generators);
  orbits.n_nodes = static_cast<int>(nodes.size());
  std::vector<std::vector<int>> group_maps(1);
  for (int node = 0; node < orbits.n_nodes; ++node) group_maps[0].push_back(node);
  while (group_maps.size() < orbits.group.size())
    group_maps.push_back(compose_map(orbits.group, group_maps, generators, maps));
  std::vector<std::pair<std::vector<SignMatrix>, std::vector<Orbit>>> by_class;
  for (int node = 0; node < orbits.n_nodes; ++node) {
    Orbit orbit = make_orbit(orbits.group, group_maps, node);
    if (std::any_of(orbit.image.begin(), orbit.image.end(),
                    [&](const int image) { return image >= 0 && image < node; }))
      continue;  // it is an image of an earlier node
    auto found = std::find_if(by_class.begin(), by_class.end(),
                              [&](const auto& known) { return known.first == orbit.stabilizer; });
    if (found == by_class.end()) found = by_class.insert(by_class.end(), {orbit.stabilizer, {}});
    found->second.push_back(std::move(orbit));
  }
  for (const auto& [stabilizer, members] : by_class) {
    orbits.classes.push_back({orbits.n_orbits(), static_cast<int>(members.size()), stabilizer});
    for (const Orbit& orbit : members) orbits.image.insert(orbits.image.end(), orbit.image.begin(), orbit.image.end());
  }
  return orbits;
}

void make_symmetric(const NodeOrbits& orbits, const std::vector<Fiber>& fibers, std::vector<Vec3>& nodes) {
  std::vector<double> allowed;
  for (const Fiber& fiber : fibers)
    allowed.insert(allowed.end(), static_cast<std::size_t>(fiber.n_nodes()), partner_tolerance * fiber.spacing());
  SKEIN_REQUIRE(nodes.size() == allowed.size() && orbits.n_nodes == static_cast<int>(nodes.size()),
                "nodes are those of the fibers");
  for (const OrbitClass& run : orbits.classes) {
    const unsigned vanishing = find_vanishing(run.stabilizer);
    for (int orbit = run.first; orbit < run.first + run.count; ++orbit) {
      const Vec3 first = without_components(vanishing, nodes[static_cast<std::size_t>(orbits.image_of(orbit, 0))]);
      for (std::size_t element = 0; element < orbits.group.size(); ++element) {
        const int node = orbits.image_of(orbit, static_cast<int>(element));
        if (node < 0) continue;
        Vec3& at = nodes[static_cast<std::size_t>(node)];
        const Vec3 wanted = orbits.group[element] * first;
        if (!(norm(at - wanted) <= allowed[static_cast<std::size_t>(node)]))
          throw Error(ExitCode::scene_error,
                      fmt::format("node {} at ({:.6g}, {:.6g}, {:.6g}) is not where the image of node {} is, at "
                                  "({:.6g}, {:.6g}, {:.6g})",
                                  node, at.x, at.y, at.z, orbits.image_of(orbit, 0), wanted.x, wanted.y, wanted.z));
        at = wanted;
      }
    }
  }
}

}  // namespace skein
