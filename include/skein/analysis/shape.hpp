#pragma once

#include <skein/analysis/signed_curvature.hpp>

#include <span>
#include <vector>

namespace skein {

/// Turning below which a part of the line does not count as a bend, radians: five degrees.
inline constexpr double least_bend_turning = 0.0873;

/// What can be said of one fiber's centreline at one moment without knowing the others. Nothing refers to the axes of
/// space; what has a sign refers to the normal.
struct Shape {
  double length = 0.0;           ///< of the line through the centroids
  Vec3 end_to_end;               ///< last centroid - first, length
  double distance = 0.0;         ///< between the ends
  Vec3 normal;                   ///< of the plane that the line is nearest to
  double curvature_max = 0.0;    ///< unsigned, 1 / length
  double total_turning = 0.0;    ///< radians
  double symmetry_defect = 0.0;  ///< departure from odd symmetry, over the line's length
  double out_of_plane = 0.0;     ///< largest distance from that plane, length
  double deflection = 0.0;       ///< root mean square distance from the line through both ends, length
  std::vector<Bend> bends;

  /// Changes the sign of the normal, and of what is counted about it.
  void turn_over();
};

/// @param reach   of the curvature, see choose_curvature_reach
/// @param normal  of the line's own plane, which has either sign: see PlaneTracker
Shape measure_shape(std::span<const Vec3> centreline, int reach, Vec3 normal);
/// The same where signs do not matter.
Shape measure_shape(std::span<const Vec3> centreline, int reach);

/// Root mean square over sections of |x(s) + x(-s) - 2 centroid| / 2, over the line's length: 0 for a shape that is odd
/// about its centroid, such as an unperturbed fiber's in shear.
double compute_symmetry_defect(std::span<const Vec3> centreline);

/// Largest distance from the plane that the line is nearest to, length.
double compute_out_of_plane(std::span<const Vec3> centreline);

/// Root mean square distance from the line through both ends, length; from the first end where they coincide.
double compute_deflection(std::span<const Vec3> centreline);

}  // namespace skein
