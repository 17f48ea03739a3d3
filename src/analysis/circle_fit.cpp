#include <skein/analysis/circle_fit.hpp>
#include <skein/analysis/plane_fit.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace skein {
namespace {

using Points2 = Eigen::Matrix<double, Eigen::Dynamic, 2>;
using Columns3 = Eigen::Matrix<double, Eigen::Dynamic, 3>;
using Factors3 = Eigen::ColPivHouseholderQR<Columns3>;  // of three columns everywhere: it is slow to compile

/// x, y of the centre and the radius: |p|^2 = 2 c.p + (r^2 - c^2) is linear in the unknowns.
Eigen::Vector3d fit_algebraic(const Points2& points) {
  Columns3 matrix(points.rows(), 3);
  matrix << 2.0 * points, Eigen::VectorXd::Ones(points.rows());
  const Eigen::VectorXd squares = points.rowwise().squaredNorm();
  const Eigen::Vector3d solution = Factors3(matrix).solve(squares);
  const double radius2 = solution[2] + solution.head<2>().squaredNorm();
  return {solution[0], solution[1], std::sqrt(std::max(radius2, 0.0))};
}

Eigen::VectorXd residuals(const Points2& points, const Eigen::Vector3d& circle) {
  return (points.rowwise() - circle.head<2>().transpose()).rowwise().norm().array() - circle[2];
}

Eigen::Vector3d refine(const Points2& points, Eigen::Vector3d circle) {
  for (int iteration = 0; iteration < 50; ++iteration) {
    Columns3 jacobian(points.rows(), 3);
    const Points2 away = points.rowwise() - circle.head<2>().transpose();
    jacobian << -away.rowwise().normalized(), -Eigen::VectorXd::Ones(points.rows());
    const Eigen::VectorXd error = residuals(points, circle);
    const Eigen::Vector3d step = Factors3(jacobian).solve(-error);
    const Eigen::Vector3d next = circle + step;
    if (!(residuals(points, next).squaredNorm() < error.squaredNorm())) break;
    circle = next;
    if (step.norm() < 1e-14 * circle[2]) break;
  }
  return circle;
}

}  // namespace

Circle fit_circle(const std::span<const Vec3> points) {
  Circle none;
  none.radius = std::numeric_limits<double>::infinity();
  const auto n = static_cast<Eigen::Index>(points.size());
  if (n < 3) return none;
  const PlaneFit plane = fit_plane(points);
  const double scale = plane.width[0];
  if (!(plane.width[1] > straight * scale)) return none;

  Points2 flat(n, 2);  // of order one
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3 d = (points[i] - plane.center) / scale;
    flat.row(i) << dot(d, plane.along), dot(d, plane.across);
  }
  const Eigen::Vector3d circle = refine(flat, fit_algebraic(flat));
  const Vec3 center = plane.center + scale * (circle[0] * plane.along + circle[1] * plane.across);
  return {center, circle[2] * scale, plane.normal,
          residuals(flat, circle).norm() * scale / std::sqrt(static_cast<double>(n))};
}

}  // namespace skein
