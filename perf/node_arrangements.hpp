#pragma once

#include <skein/core/vec3.hpp>

#include <vector>

namespace skein::perf {

// Where the benches of the fast multipole method put their nodes, length.

inline constexpr double fiber_blob = 0.00225;  ///< of the paper's fibers, to which tube and spiral belong

/// A straight tube of sections of 18 nodes.
std::vector<Vec3> make_straight(int n_nodes);

double tube_length(int n_nodes);

/// The same tube coiled to a planar Archimedean spiral whose arms are 0.03 apart.
std::vector<Vec3> make_spiral(int n_nodes);

/// Straight tubes anywhere in a cube, in any direction: five in a cube of their length. They may cross.
std::vector<Vec3> make_suspension(int n_fibers, int n_sections, int n_around);

/// Anywhere in the unit cube.
std::vector<Vec3> make_uniform(int n_nodes);

}  // namespace skein::perf
