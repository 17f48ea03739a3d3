#pragma once

#include <skein/scene/scene_config.hpp>

#include <string>

namespace skein {

/// How well a tube of fewer or more nodes stands for another.
struct RungFit {
  FiberConfig fiber;
  double aspect_ratio_error = 0.0;  ///< of the rigid tube, cut to 120 radii at most: relative difference
  double drag_ratio = 1.0;          ///< of such tubes, against turning: the rung's over the fiber's
};

/// The fiber with other numbers of nodes: length and radius kept, by the blob the effective aspect ratio of the rigid
/// tube, so that a shear turns it alike, and by the springs the bending rigidity (at equilibrium) over the drag against
/// turning, so that the same flow bends it alike. With the blob kept, tubes of fewer nodes are thinner to the fluid,
/// and leak. Sections are about as far apart as neighbours on one, so that whole ones make up the length.
///
/// @param nodes_per_section  at least 3; those that the fiber has change nothing
/// @throws Error(scene_error) where no blob serves, between a fifth of the nodes' distance and two and a half of it
RungFit fit_rung(const FiberConfig& fiber, int nodes_per_section);

/// Of a fiber as it is written.
int find_rung(const FiberConfig& fiber);

/// Why no rigid fibers can stand for a scene's; empty where they can.
std::string find_bar_to_rigid(const SceneConfig& scene);

/// The scene with every fiber so, or, with one of the rungs below, as a chain or rigid (see resolve_chains); sections
/// that tethers hold and torques turn are the nearest ones.
/// @throws Error(scene_error) as fit_rung and resolve_chains do
SceneConfig make_rung_scene(SceneConfig scene, int rung);

}  // namespace skein
