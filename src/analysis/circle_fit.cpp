#include <skein/analysis/circle_fit.hpp>

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
  Columns3 all(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) all.row(i) << points[i].x, points[i].y, points[i].z;
  const Eigen::RowVector3d middle = all.colwise().mean();
  all.rowwise() -= middle;
  // The singular values and right vectors of A P = Q R are those of R P^T.
  const Factors3 qr(all);
  const Eigen::Matrix3d triangle = qr.matrixR().topRows<3>().triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Eigen::Matrix3d> plane(triangle * qr.colsPermutation().transpose(), Eigen::ComputeFullV);
  const auto& width = plane.singularValues();
  constexpr double straight = 1e-9;
  if (!(width[1] > straight * width[0])) return none;

  const Points2 flat = (all * plane.matrixV().leftCols<2>()) / width[0];  // of order one
  const Eigen::Vector3d circle = refine(flat, fit_algebraic(flat));
  const Eigen::Vector3d center = middle.transpose() + plane.matrixV().leftCols<2>() * circle.head<2>() * width[0];
  const Eigen::Vector3d normal = plane.matrixV().col(2);
  return {{center[0], center[1], center[2]},
          circle[2] * width[0],
          {normal[0], normal[1], normal[2]},
          residuals(flat, circle).norm() * width[0] / std::sqrt(static_cast<double>(n))};
}

}  // namespace skein
