#pragma once

#include <skein/scene/scene_config.hpp>

namespace skein {

/// Nodes on a section of the paper's fibers.
constexpr int paper_nodes_per_section = 18;
/// Of all the paper's fibers, length
constexpr double paper_radius = 0.005;

/// A fiber of LaGrone, Cortez, Yan, Fauci 2019 in their shear flow, in their units: straight along x at t = 0.
/// @param sections  N_f; the length is N_f 0.00173648
SceneConfig make_paper_scene(int sections, double end);

/// N_f of the fiber that comes nearest to a length, at least 2.
int count_paper_sections(double length);

}  // namespace skein
