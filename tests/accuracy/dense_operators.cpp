#include "tests/accuracy/dense_operators.hpp"

#include <cmath>
#include <cstdlib>

namespace skein::dense {
namespace {

/// Sum of the spring blocks of a node of a section: each of its springs resists its own displacement.
Eigen::Matrix3d sum_of_springs(const FiberConfig& config, const Points& points, const int node) {
  const int n = config.nodes_per_section;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int other = 0; other < static_cast<int>(points.size()); ++other) {
    if (other == node || std::abs(other / n - node / n) > 1) continue;
    sum += spring_block(points[node] - points[other], config.spring_stiffness);
  }
  return sum;
}

Eigen::Matrix3d stiffness_block(const FiberConfig& config, const Points& points, const int node, const int other) {
  const int n = config.nodes_per_section;
  if (node == other) return sum_of_springs(config, points, node);
  if (std::abs(other / n - node / n) > 1) return Eigen::Matrix3d::Zero();
  return -spring_block(points[node] - points[other], config.spring_stiffness);
}

}  // namespace

Points make_straight_tube(const FiberConfig& config) {
  const double chord = 2.0 * config.radius * std::sin(EIGEN_PI / config.nodes_per_section);
  const double spacing = config.spacing > 0.0 ? config.spacing : chord;
  Points points;
  for (int s = 0; s < config.sections; ++s)
    for (int a = 0; a < config.nodes_per_section; ++a) {
      const double angle = 2.0 * EIGEN_PI * a / config.nodes_per_section;
      points.emplace_back((s - 0.5 * (config.sections - 1)) * spacing, config.radius * std::cos(angle),
                          config.radius * std::sin(angle));
    }
  return points;
}

Eigen::Matrix3d mobility_block(const Eigen::Vector3d& d, const double blob, const double viscosity) {
  const double r2 = d.squaredNorm();
  const double e2 = blob * blob;
  const double scale = 1.0 / (8.0 * EIGEN_PI * viscosity * std::pow(r2 + e2, 1.5));
  return scale * ((r2 + 2.0 * e2) * Eigen::Matrix3d::Identity() + d * d.transpose());
}

Eigen::MatrixXd make_mobility(const Points& points, const double blob, const double viscosity) {
  const int n = static_cast<int>(points.size());
  Eigen::MatrixXd mobility(3 * n, 3 * n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      mobility.block<3, 3>(3 * i, 3 * j) = mobility_block(points[i] - points[j], blob, viscosity);
  return mobility;
}

Eigen::Matrix3d spring_block(const Eigen::Vector3d& d, const double stiffness) {
  return stiffness / std::pow(d.norm(), 3) * d * d.transpose();
}

Eigen::MatrixXd make_stiffness(const FiberConfig& config) {
  const Points points = make_straight_tube(config);
  const int n = static_cast<int>(points.size());
  Eigen::MatrixXd stiffness(3 * n, 3 * n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) stiffness.block<3, 3>(3 * i, 3 * j) = stiffness_block(config, points, i, j);
  return stiffness;
}

Eigen::Matrix3d section_frame(const double angle) {
  Eigen::Matrix3d frame;
  frame << 1.0, 0.0, 0.0,                      //
      0.0, std::cos(angle), -std::sin(angle),  //
      0.0, std::sin(angle), std::cos(angle);
  return frame;
}

Eigen::MatrixXcd make_mobility_mode(const FiberConfig& config, const double viscosity, const int mode) {
  const Points points = make_straight_tube(config);
  const int n = config.nodes_per_section;
  return make_angular_mode(config, mode, [&](const int s, const int t, const int b) {
    return mobility_block(points[s * n] - points[t * n + b], config.blob, viscosity);
  });
}

Eigen::MatrixXcd make_stiffness_mode(const FiberConfig& config, const int mode) {
  const Points points = make_straight_tube(config);
  const int n = config.nodes_per_section;
  return make_angular_mode(config, mode, [&](const int s, const int t, const int b) {
    return stiffness_block(config, points, s * n, t * n + b);
  });
}

}  // namespace skein::dense
