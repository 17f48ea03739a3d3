#pragma once

#include <skein/fibers/start_shape.hpp>

#include <vector>

namespace skein {

/// A piece of tube with flat ends: everything between two circular sections, their convex hull.
struct TubePiece {
  SectionPose first, last;
  double radius = 0.0;
};

/// True where a plane lies between the two, by the algorithm of Gilbert, Johnson and Keerthi (IEEE J. Robot. Autom. 4,
/// 193, 1988). Pieces that are nearer than about 1e-7 of their size may count as touching, which is not apart.
bool are_apart(const TubePiece& a, const TubePiece& b);

/// @param poses  of a tube's sections; one piece where they lie on a line, else one from each to the next
std::vector<TubePiece> list_tube_pieces(const std::vector<SectionPose>& poses, double radius);

}  // namespace skein
