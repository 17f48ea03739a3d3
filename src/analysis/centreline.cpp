#include <skein/analysis/centreline.hpp>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

/// 1 / radius of the circle through three points: 4 times the triangle's area over the product of its sides.
double circle_curvature(const Vec3 a, const Vec3 b, const Vec3 c) {
  const Vec3 ab = b - a, bc = c - b, ac = c - a;
  const double sides = norm(ab) * norm(bc) * norm(ac);
  return sides > 0.0 ? 2.0 * norm(cross(ab, ac)) / sides : 0.0;
}

}  // namespace

std::vector<double> compute_curvature(const std::span<const Vec3> centreline, const int reach) {
  const int n = static_cast<int>(centreline.size());
  std::vector<double> curvature(centreline.size(), 0.0);
  if (n < 3) return curvature;
  for (int s = 1; s < n - 1; ++s) {
    const int step = std::min({reach, s, n - 1 - s});
    curvature[s] = circle_curvature(centreline[s - step], centreline[s], centreline[s + step]);
  }
  curvature.front() = curvature[1];
  curvature.back() = curvature[n - 2];
  return curvature;
}

double compute_length(const std::span<const Vec3> centreline) {
  double length = 0.0;
  for (std::size_t s = 1; s < centreline.size(); ++s) length += norm(centreline[s] - centreline[s - 1]);
  return length;
}

Vec3 compute_end_to_end(const std::span<const Vec3> centreline) { return centreline.back() - centreline.front(); }

}  // namespace skein
