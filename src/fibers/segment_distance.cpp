#include <skein/fibers/segment_distance.hpp>

#include <algorithm>

namespace skein {
namespace {

double distance_from_piece(const Vec3 point, const Vec3 a, const Vec3 b) {
  const Vec3 along = b - a;
  const double length_squared = dot(along, along);
  const double share = length_squared > 0.0 ? std::clamp(dot(point - a, along) / length_squared, 0.0, 1.0) : 0.0;
  return norm(point - a - share * along);
}

}  // namespace

// The smallest distance is at an end of one of them, or where the lines through them are nearest, if that is inside
// both.
double compute_segment_distance(const Vec3 a, const Vec3 b, const Vec3 c, const Vec3 d) {
  double distance = std::min({distance_from_piece(a, c, d), distance_from_piece(b, c, d), distance_from_piece(c, a, b),
                              distance_from_piece(d, a, b)});
  const Vec3 first = b - a, second = d - c, between = a - c;
  const double ff = dot(first, first), ss = dot(second, second), fs = dot(first, second);
  const double determinant = ff * ss - fs * fs;
  if (determinant > 0.0) {
    const double on_first = (fs * dot(second, between) - ss * dot(first, between)) / determinant;
    const double on_second = (ff * dot(second, between) - fs * dot(first, between)) / determinant;
    if (on_first >= 0.0 && on_first <= 1.0 && on_second >= 0.0 && on_second <= 1.0)
      distance = std::min(distance, norm(between + on_first * first - on_second * second));
  }
  return distance;
}

}  // namespace skein
