#include <skein/analysis/centreline.hpp>
#include <skein/analysis/orientation.hpp>
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
  const double middle = compute_centroid(line).z;
  double largest = 0.0;
  for (const Vec3 point : line) largest = std::max(largest, std::abs(point.z - middle));
  return largest;
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

Shape measure_shape(const std::span<const Vec3> line, const int reach) {
  Shape shape;
  const auto arclength = compute_arclength(line);
  const auto curvature = compute_signed_curvature(line, reach);
  const Vec3 ends = compute_end_to_end(line);
  shape.length = arclength.back();
  shape.distance = norm(ends);
  shape.angle = compute_clockwise_angle(ends);
  for (const double kappa : curvature) shape.curvature_max = std::max(shape.curvature_max, std::abs(kappa));
  shape.total_turning = compute_total_turning(arclength, curvature);
  shape.symmetry_defect = compute_symmetry_defect(line);
  shape.out_of_plane = compute_out_of_plane(line);
  shape.deflection = compute_deflection(line);
  shape.bends = find_bends(arclength, curvature, least_bend_turning);
  return shape;
}

}  // namespace skein
