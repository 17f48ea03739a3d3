#pragma once

#include <skein/core/vec3.hpp>
#include <skein/io/vtk_image.hpp>

#include <string>
#include <vector>

namespace skein {

/// Where a velocity field is asked for: a plane, a box, or what is around the fibers.
struct FieldBounds {
  std::string plane;        ///< normal and place, "z" or "y=0.1"; empty: none, or z where there is no box either
  std::vector<double> box;  ///< x0, x1, y0, y1, z0, z1, length; empty: around the nodes
  int points = 0;           ///< along the longest side; 0: 200 on a plane, 64 in a box
};

/// The grid that covers the bounds from side to side: its first points lie on the near sides, its last on the far ones.
/// The longest side has `points` points, a shorter one as many as make its spacing equal to that of the longest or,
/// where they would not end on its far side, smaller.
/// @param nodes  [n_nodes], length
/// @throws Error(usage) naming the option for bounds that are no finite box, or too large or too thin for such a grid
ImageGrid make_field_grid(const FieldBounds& bounds, const std::vector<Vec3>& nodes);

}  // namespace skein
