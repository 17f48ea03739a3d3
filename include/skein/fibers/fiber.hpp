#pragma once

#include <skein/core/vec3.hpp>
#include <skein/scene/scene_config.hpp>

#include <cstdint>
#include <vector>

namespace skein {

/// Two sections of one fiber are distant from each other when at least this many radii of fiber lie between them.
inline constexpr double distant_radii = 10.0;

/// Where one fiber's nodes and sections lie in the arrays of all fibers, and its straight shape.
/// Node `a` of section `s` has the index first_node + s * nodes_per_section + a.
struct Fiber {
  FiberConfig config;
  int first_node = 0;
  int first_section = 0;
  int index = 0;  ///< of the fiber among all

  int n_nodes() const { return config.sections * config.nodes_per_section; }
  /// Between sections, length: the chord 2 R sin(pi / N_c) between neighbours on a section unless the scene says other.
  double spacing() const;
  double length() const;  ///< N_f * spacing, length
  /// Sections whose numbers differ by this much or more are distant from each other.
  int distant_sections() const;
};

/// Fibers in the order of the scene, one after the other without gaps. Chains that stand for tubes are laid out before,
/// see resolve_chains.
std::vector<Fiber> make_fibers(const std::vector<FiberConfig>& configs);

int count_nodes(const std::vector<Fiber>& fibers);
int count_sections(const std::vector<Fiber>& fibers);
/// The one that a node, of all, is on.
const Fiber& find_fiber_of(const std::vector<Fiber>& fibers, int node);
/// Of the longest: the unit of errors. @returns length
double largest_length(const std::vector<Fiber>& fibers);

/// Nodes at the start. Straight fibers: node a of section s at angle 2 pi a / N_c on the circle of radius R about
/// center + (s - (N_f - 1)/2) spacing direction; the node of a chain's section stands on that point. Angle 0 points
/// along y for a fiber along x with roll 0. Bent ones: the same on the sections of make_section_poses.
/// @param seed  of random bends
/// @returns [n_nodes], length
std::vector<Vec3> make_surface_nodes(const std::vector<Fiber>& fibers, std::uint64_t seed = 1);

/// The blob of every node. @returns [n_nodes], length
std::vector<double> make_blobs(const std::vector<Fiber>& fibers);

}  // namespace skein
