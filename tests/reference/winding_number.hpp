#pragma once

#include <skein/core/vec3.hpp>

#include <array>
#include <vector>

namespace skein::reference {

using Triangle = std::array<Vec3, 3>;

/// The closed surface of a tube of rings of n nodes each: two triangles for each quadrilateral between rings, fans
/// about the means of the nodes of the first and of the last ring. Corners go counter-clockwise for an eye outside,
/// where the rings do so about the direction in which they follow each other.
struct Tube {
  std::vector<Triangle> sides, first_end, last_end;
};
Tube make_tube(const std::vector<Vec3>& nodes, int nodes_per_ring);

/// How often triangles wind about a point: crossings of a ray from it, those outwards less those inwards. The ray has
/// no special direction; it must meet no edge.
int count_windings(const std::vector<Triangle>& triangles, Vec3 point);

/// Length
double compute_distance(const std::vector<Triangle>& triangles, Vec3 point);

}  // namespace skein::reference
