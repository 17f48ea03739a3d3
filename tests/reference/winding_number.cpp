#include "tests/reference/winding_number.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein::reference {
namespace {

std::vector<Triangle> make_fan(const Vec3* ring, const int n, const bool turns_over) {
  Vec3 mean;
  for (int a = 0; a < n; ++a) mean = mean + ring[a] / n;
  std::vector<Triangle> fan;
  for (int a = 0; a < n; ++a) {
    const Vec3 b = ring[a], c = ring[(a + 1) % n];
    fan.push_back(turns_over ? Triangle{mean, c, b} : Triangle{mean, b, c});
  }
  return fan;
}

/// Of the nearest point of a triangle, whose coordinates along two of its sides are found by regions.
double squared_distance(const Triangle& triangle, const Vec3 point) {
  const Vec3 u = triangle[1] - triangle[0], v = triangle[2] - triangle[0], p = point - triangle[0];
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), up = dot(u, p), vp = dot(v, p);
  const auto at = [&](const double s, const double t) {
    const Vec3 d = p - s * u - t * v;
    return dot(d, d);
  };
  const double determinant = uu * vv - uv * uv;
  const double s = (vv * up - uv * vp) / determinant, t = (uu * vp - uv * up) / determinant;
  if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) return at(s, t);
  const double on_u = std::clamp(up / uu, 0.0, 1.0), on_v = std::clamp(vp / vv, 0.0, 1.0);
  const double across = std::clamp((vp - up - uv + uu) / (uu - 2.0 * uv + vv), 0.0, 1.0);  // from u to v
  return std::min({at(on_u, 0.0), at(0.0, on_v), at(1.0 - across, across)});
}

}  // namespace

Tube make_tube(const std::vector<Vec3>& nodes, const int n) {
  const int n_rings = static_cast<int>(nodes.size()) / n;
  Tube tube;
  for (int ring = 0; ring + 1 < n_rings; ++ring)
    for (int a = 0; a < n; ++a) {
      const Vec3 here = nodes[ring * n + a], beside = nodes[ring * n + (a + 1) % n];
      const Vec3 above = nodes[(ring + 1) * n + a], above_beside = nodes[(ring + 1) * n + (a + 1) % n];
      tube.sides.push_back({here, beside, above});
      tube.sides.push_back({beside, above_beside, above});
    }
  tube.first_end = make_fan(nodes.data(), n, true);
  tube.last_end = make_fan(nodes.data() + (n_rings - 1) * n, n, false);
  return tube;
}

int count_windings(const std::vector<Triangle>& triangles, const Vec3 point) {
  const Vec3 ray{0.5377, 0.3421, -0.7706};
  int n = 0;
  for (const auto& [a, b, c] : triangles) {
    const Vec3 u = b - a, v = c - a, from = point - a;
    const Vec3 across = cross(ray, v);
    const double determinant = dot(u, across);
    if (determinant == 0.0) continue;
    const double s = dot(from, across) / determinant;
    const double t = dot(ray, cross(from, u)) / determinant;
    const double along = dot(v, cross(from, u)) / determinant;
    if (s >= 0.0 && t >= 0.0 && s + t <= 1.0 && along > 0.0) n += dot(ray, cross(u, v)) > 0.0 ? 1 : -1;
  }
  return n;
}

double compute_distance(const std::vector<Triangle>& triangles, const Vec3 point) {
  double least = std::numeric_limits<double>::max();
  for (const Triangle& triangle : triangles) least = std::min(least, squared_distance(triangle, point));
  return std::sqrt(least);
}

}  // namespace skein::reference
