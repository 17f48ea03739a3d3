#pragma once

#include <skein/core/vec3.hpp>

#include <cmath>
#include <functional>
#include <vector>

namespace skein {

/// A line of unit-speed steps whose tangent's angle (counter-clockwise from +x) is a given function of arclength,
/// integrated by the midpoint rule in twenty parts of a section's distance; its centroid at the origin.
inline std::vector<Vec3> make_plane_curve(const int n_sections, const double spacing,
                                          const std::function<double(double)>& tangent_angle) {
  constexpr int parts = 20;
  std::vector<Vec3> line{{0.0, 0.0, 0.0}};
  Vec3 point, sum;
  for (int s = 1; s < n_sections; ++s) {
    for (int part = 0; part < parts; ++part) {
      const double angle = tangent_angle((s - 1 + (part + 0.5) / parts) * spacing);
      point = point + spacing / parts * Vec3{std::cos(angle), std::sin(angle), 0.0};
    }
    line.push_back(point);
    sum = sum + point;
  }
  for (Vec3& p : line) p = p - sum / n_sections;
  return line;
}

}  // namespace skein
