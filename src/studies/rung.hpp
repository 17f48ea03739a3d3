#pragma once

#include <skein/scene/scene_config.hpp>

#include <string>

namespace skein {

/// How well a tube of fewer or more nodes stands for another.
struct RungFit {
  FiberConfig fiber;
  double aspect_ratio_error = 0.0;  ///< of the rigid tube, cut to 120 radii at most: relative difference
};

/// The fiber with other numbers of nodes: length, radius and bending rigidity (of rigid sections) kept, and by the blob
/// the effective aspect ratio of the rigid tube, so that it is to the fluid what it was. With the blob kept, tubes of
/// fewer nodes are thinner to the fluid, and leak. Sections are about as far apart as neighbours on one, so that whole
/// ones make up the length.
///
/// @param nodes_per_section  at least 3; those that the fiber has change nothing
/// @throws Error(scene_error) where no blob serves, between a fifth of the nodes' distance and two and a half of it
RungFit fit_rung(const FiberConfig& fiber, int nodes_per_section);

/// The rungs below all tubes.
inline constexpr int rigid_rung = 0, chain_rung = 1;

/// Of a fiber as it is written.
int find_rung(const FiberConfig& fiber);

/// In words, such as "5 nodes on a section".
std::string name_rung(int nodes_per_section);

/// Why no rigid fibers can stand for a scene's; empty where they can.
std::string find_bar_to_rigid(const SceneConfig& scene);

/// The scene with every fiber so, or, with one of the rungs below, as a chain or rigid (see resolve_chains); sections
/// that tethers hold and torques turn are the nearest ones.
SceneConfig make_rung_scene(SceneConfig scene, int nodes_per_section);

}  // namespace skein
