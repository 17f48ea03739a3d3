#include <skein/analysis/centreline.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein {
namespace {

/// 1 / radius of the circle through three points: 4 times the triangle's area over the product of its sides.
double circle_curvature(const Vec3 a, const Vec3 b, const Vec3 c) {
  const Vec3 ab = b - a, bc = c - b, ac = c - a;
  const double sides = norm(ab) * norm(bc) * norm(ac);
  return sides > 0.0 ? 2.0 * norm(cross(ab, ac)) / sides : 0.0;
}

double longest_segment(const std::span<const Vec3> line) {
  double longest = 0.0;
  for (std::size_t s = 1; s < line.size(); ++s) longest = std::max(longest, norm(line[s] - line[s - 1]));
  return longest;
}

/// Smallest distance from a point to the sections of a line from `first` on. Sections that cannot be nearer than the
/// smallest distance so far, because no segment is longer than `longest`, are passed over.
double distance_to_line(const Vec3 point, const std::span<const Vec3> line, std::size_t first, const double longest,
                        double smallest) {
  while (first < line.size()) {
    const double distance = norm(line[first] - point);
    smallest = std::min(smallest, distance);
    const double spare = longest > 0.0 ? (distance - smallest) / longest : 0.0;
    first += 1 + static_cast<std::size_t>(std::min(spare, static_cast<double>(line.size())));
  }
  return smallest;
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

double compute_smallest_gap(const std::vector<Fiber>& fibers, const std::vector<Vec3>& centreline) {
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < fibers.size(); ++f) {
    const auto line = centreline_of(fibers[f], centreline);
    const double longest = longest_segment(line);
    const double radius = fibers[f].config.radius;
    const auto apart = static_cast<std::size_t>(fibers[f].distant_sections());
    for (std::size_t s = 0; s + apart < line.size(); ++s)
      gap = std::min(gap, distance_to_line(line[s], line, s + apart, longest, gap + 2.0 * radius) - 2.0 * radius);
    for (std::size_t g = f + 1; g < fibers.size(); ++g) {
      const double radii = radius + fibers[g].config.radius;
      const auto other = centreline_of(fibers[g], centreline);
      const double longest_other = longest_segment(other);
      for (const Vec3 point : line)
        gap = std::min(gap, distance_to_line(point, other, 0, longest_other, gap + radii) - radii);
    }
  }
  return gap;
}

}  // namespace skein
