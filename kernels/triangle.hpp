#pragma once

#include <skein/arrays/types.hpp>

#include <math.h>

namespace skein {

/// Solid angle of a triangle seen from the origin, in (-2 pi, 2 pi]; positive where its corners, seen from the side on
/// which the origin is not, go counter-clockwise. Corners that the origin lies on add nothing. Van Oosterom and
/// Strackee, IEEE Trans. Biomed. Eng. 30, 125 (1983).
KOKKOS_INLINE_FUNCTION double solid_angle(const Vec3 a, const Vec3 b, const Vec3 c) {
  const double to_a = norm(a), to_b = norm(b), to_c = norm(c);
  // The global atan2, which hosts and devices have.
  return 2.0 *
         ::atan2(dot(a, cross(b, c)), to_a * to_b * to_c + dot(a, b) * to_c + dot(a, c) * to_b + dot(b, c) * to_a);
}

/// Square of the distance from the origin to the straight piece from a to b, which may be a point.
KOKKOS_INLINE_FUNCTION double squared_distance_to_piece(const Vec3 a, const Vec3 b) {
  const Vec3 along = b - a;
  const double square = dot(along, along);
  double share = square > 0.0 ? -dot(a, along) / square : 0.0;
  share = share < 0.0 ? 0.0 : (share > 1.0 ? 1.0 : share);
  const Vec3 nearest = a + share * along;
  return dot(nearest, nearest);
}

/// Square of the distance from the origin to a triangle, which may be a piece of a line or a point.
KOKKOS_INLINE_FUNCTION double squared_distance_to_triangle(const Vec3 a, const Vec3 b, const Vec3 c) {
  const Vec3 normal = cross(b - a, c - a);
  const double square = dot(normal, normal);
  // The foot of the perpendicular is in the triangle where the origin is on the inner side of all three edges.
  if (square > 0.0 && dot(cross(a, b), normal) >= 0.0 && dot(cross(b, c), normal) >= 0.0 &&
      dot(cross(c, a), normal) >= 0.0) {
    const double height = dot(a, normal);
    return height * height / square;
  }
  const double ab = squared_distance_to_piece(a, b), bc = squared_distance_to_piece(b, c),
               ca = squared_distance_to_piece(c, a);
  const double least = ab < bc ? ab : bc;
  return least < ca ? least : ca;
}

}  // namespace skein
