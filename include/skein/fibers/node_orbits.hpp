#pragma once

#include <skein/core/orbit_class.hpp>
#include <skein/core/vec3.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/scene/scene_config.hpp>

#include <string>
#include <vector>

namespace skein {

/// A node's image may be this far from where its partner stands, in spacings of the fiber's sections.
inline constexpr double partner_tolerance = 1e-4;

/// The node that each node is mapped onto.
struct NodeMap {
  std::vector<int> image;  ///< [n_nodes]; empty where some node has no partner
  std::string fault;       ///< the first node without partner, and why, in words; empty where all have one
};

/// Maps whole fibers onto fibers that are alike, sections in order or in reverse, so that springs are mapped onto
/// springs that are as stiff.
/// @param nodes  [n_nodes] of the fibers, length
NodeMap find_node_map(const std::vector<Fiber>& fibers, const std::vector<Vec3>& nodes, SignMatrix matrix);

/// The matrix of a key; the identity for "none".
SignMatrix make_mirror(SymmetryAxis normal);
SignMatrix make_half_turn(SymmetryAxis axis);

/// "in the plane z = 0 and under a half turn about z". Empty for a scene without symmetry.
std::string describe_symmetry(const SymmetryConfig& symmetry);

/// Nodes that are images of each other, orbits of one class after the other. An orbit is known by its first node, the
/// others are that one's images.
struct NodeOrbits {
  std::vector<SignMatrix> group;    ///< the identity comes first
  std::vector<OrbitClass> classes;  ///< together all orbits
  /// [n_orbits, group.size()]: the image of the orbit's first node under each matrix; -1 where it is one of before
  std::vector<int> image;
  int n_nodes = 0;

  int n_orbits() const { return group.empty() ? 0 : static_cast<int>(image.size() / group.size()); }
  int image_of(const int orbit, const int element) const {
    return image[static_cast<std::size_t>(orbit) * group.size() + static_cast<std::size_t>(element)];
  }

  /// How many times fewer pairs are weighed by orbits than by all nodes.
  double gain() const;

  /// Of a sum over images: "by 800 of 1440 nodes and their images, 1.98 times fewer pairs".
  std::string describe_images() const;
  /// Of a sum over all nodes: "for 800 of 1440 nodes, of which all others are images".
  std::string describe_targets() const;
};

/// @param nodes  [n_nodes] of the fibers, length
/// @throws Error(scene_error) where they lack a symmetry, with the first node without partner
NodeOrbits make_node_orbits(const SymmetryConfig& symmetry, const std::vector<Fiber>& fibers,
                            const std::vector<Vec3>& nodes);

/// Makes positions exactly symmetric: those of first nodes are kept, but for components that cannot be but zero.
/// @param nodes  [n_nodes], length
/// @throws Error(scene_error) where a node would be moved by more than partner_tolerance, naming it
void make_symmetric(const NodeOrbits& orbits, const std::vector<Fiber>& fibers, std::vector<Vec3>& nodes);

}  // namespace skein
