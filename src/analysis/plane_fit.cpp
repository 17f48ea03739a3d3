#include <skein/analysis/plane_fit.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace skein {
namespace {

using Rows3 = Eigen::Matrix<double, Eigen::Dynamic, 3>;

Vec3 compute_mean(const std::span<const Vec3> points) {
  Vec3 sum;
  for (const Vec3 point : points) sum = sum + point;
  return points.empty() ? sum : sum / static_cast<double>(points.size());
}

/// A unit vector at right angles to one of length 1.
Vec3 find_perpendicular(const Vec3 v) {
  const Vec3 axis = std::abs(v.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 across = cross(v, axis);
  return across / norm(across);
}

}  // namespace

PlaneFit fit_plane(const std::span<const Vec3> points, const Vec3 preferred) {
  PlaneFit plane;
  plane.center = compute_mean(points);
  plane.along = {1.0, 0.0, 0.0};
  plane.across = {0.0, 1.0, 0.0};
  plane.normal = {0.0, 0.0, 1.0};
  const auto n = static_cast<Eigen::Index>(points.size());
  if (n == 0) return plane;
  double extent = 0.0;
  for (const Vec3 point : points) extent = std::max(extent, norm(point - plane.center));
  if (!(extent > 0.0) || !std::isfinite(extent)) return plane;

  // Two rows of rounding's size against normals other than the preferred one decide where the points do not.
  const bool has_preference = norm(preferred) > 0.0;
  Rows3 rows(n + (has_preference ? 2 : 0), 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3 d = (points[i] - plane.center) / extent;
    rows.row(i) << d.x, d.y, d.z;
  }
  if (has_preference) {
    const Vec3 wanted = preferred / norm(preferred), u = find_perpendicular(wanted), v = cross(wanted, u);
    const double weight = straight * std::sqrt(static_cast<double>(n));
    rows.row(n) << weight * u.x, weight * u.y, weight * u.z;
    rows.row(n + 1) << weight * v.x, weight * v.y, weight * v.z;
  }
  // The singular values and right vectors of A P = Q R are those of R P^T.
  Eigen::Matrix3d triangle = Eigen::Matrix3d::Zero();
  const Eigen::ColPivHouseholderQR<Rows3> qr(rows);
  const Eigen::Index n_kept = std::min<Eigen::Index>(rows.rows(), 3);
  triangle.topRows(n_kept) = qr.matrixR().topRows(n_kept);
  triangle = triangle.triangularView<Eigen::Upper>().toDenseMatrix() * qr.colsPermutation().transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> decomposition(triangle, Eigen::ComputeFullV);
  const auto column = [&](const int i) {
    const Eigen::Vector3d v = decomposition.matrixV().col(i);
    return Vec3{v[0], v[1], v[2]};
  };
  plane.along = column(0);
  plane.across = column(1);
  plane.normal = column(2);
  for (int i = 0; i < 3; ++i) plane.width[i] = extent * decomposition.singularValues()[i];
  return plane;
}

double find_largest_height(const std::span<const Vec3> points, const Vec3 normal) {
  const Vec3 center = compute_mean(points);
  double largest = 0.0;
  for (const Vec3 point : points) largest = std::max(largest, std::abs(dot(point - center, normal)));
  return largest;
}

}  // namespace skein
