#include <skein/analysis/centreline.hpp>
#include <skein/analysis/plane_fit.hpp>
#include <skein/analysis/shape.hpp>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

Vec3 compute_centroid(const std::span<const Vec3> line) {
  Vec3 sum;
  for (const Vec3 point : line) sum = sum + point;
  return sum / static_cast<double>(line.size());
}

}  // namespace

double compute_symmetry_defect(const std::span<const Vec3> line) {
  const Vec3 middle = compute_centroid(line);
  double sum = 0.0;
  for (std::size_t s = 0; s < line.size(); ++s) {
    const Vec3 defect = 0.5 * (line[s] + line[line.size() - 1 - s]) - middle;
    sum += dot(defect, defect);
  }
  const double length = compute_length(line);
  return length > 0.0 ? std::sqrt(sum / static_cast<double>(line.size())) / length : 0.0;
}

double compute_out_of_plane(const std::span<const Vec3> line) {
  return find_largest_height(line, fit_plane(line).normal);
}

double compute_deflection(const std::span<const Vec3> line) {
  const Vec3 ends = compute_end_to_end(line);
  const double distance = norm(ends);
  const Vec3 chord = distance > 0.0 ? ends / distance : Vec3{};
  double sum = 0.0;
  for (const Vec3 point : line) {
    const Vec3 from_end = point - line.front();
    const Vec3 across = from_end - dot(from_end, chord) * chord;
    sum += dot(across, across);
  }
  return std::sqrt(sum / static_cast<double>(line.size()));
}

void Shape::turn_over() {
  normal = -normal;
  for (Bend& bend : bends) bend.turning = -bend.turning;
}

Shape measure_shape(const std::span<const Vec3> line, const int reach, const Vec3 normal) {
  Shape shape;
  const auto arclength = compute_arclength(line);
  const auto curvature = compute_signed_curvature(line, reach, normal);
  shape.length = arclength.back();
  shape.end_to_end = compute_end_to_end(line);
  shape.distance = norm(shape.end_to_end);
  shape.normal = normal;
  for (const double kappa : curvature) shape.curvature_max = std::max(shape.curvature_max, std::abs(kappa));
  shape.total_turning = compute_total_turning(arclength, curvature);
  shape.symmetry_defect = compute_symmetry_defect(line);
  shape.out_of_plane = find_largest_height(line, normal);
  shape.deflection = compute_deflection(line);
  shape.bends = find_bends(arclength, curvature, least_bend_turning);
  return shape;
}

Shape measure_shape(const std::span<const Vec3> line, const int reach) {
  return measure_shape(line, reach, fit_plane(line).normal);
}

}  // namespace skein
