#pragma once

#include <skein/fibers/fiber.hpp>

#include "tests/accuracy/dense_operators.hpp"

#include <functional>
#include <vector>

namespace skein::dense {

inline Eigen::Vector3d to_eigen(const Vec3 v) { return {v.x, v.y, v.z}; }

/// All fibers at once: M g - K V = -flow on the nodes of rigid ones, whose sums and torques are those of the forces,
/// and velocities of the others follow. Nothing of the library's but the scene's forces, blobs and places.
struct RigidMotion {
  std::vector<Vec3> velocity, force;

  /// @param given  the scene's forces
  RigidMotion(const std::vector<Fiber>& fibers, const std::vector<Vec3>& position, const std::vector<Vec3>& given,
              const double viscosity, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& flow) {
    const int n = static_cast<int>(position.size());
    const std::vector<double> blob = make_blobs(fibers);
    Eigen::MatrixXd mobility(3 * n, 3 * n);
    Eigen::VectorXd f(3 * n), background(3 * n);
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector3d x = to_eigen(position[i]);
      for (int j = 0; j < n; ++j)
        mobility.block<3, 3>(3 * i, 3 * j) = mobility_block(x - to_eigen(position[j]), blob[j], viscosity);
      f.segment<3>(3 * i) = to_eigen(given[i]);
      background.segment<3>(3 * i) = flow(x);
    }
    std::vector<int> rows;  // of rigid fibers' nodes
    int n_bodies = 0;
    for (const Fiber& fiber : fibers) {
      if (!fiber.config.is_rigid()) continue;
      ++n_bodies;
      for (int row = 3 * fiber.first_node; row < 3 * (fiber.first_node + fiber.n_nodes()); ++row) rows.push_back(row);
    }
    const int m = static_cast<int>(rows.size());
    Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(m, 5 * n_bodies);
    int row = 0, column = 0;
    for (const Fiber& fiber : fibers) {
      if (!fiber.config.is_rigid()) continue;
      const Eigen::Vector3d axis = to_eigen(fiber.config.direction).normalized(),
                            center = to_eigen(fiber.config.center);
      const Eigen::Vector3d first = axis.unitOrthogonal(), second = axis.cross(first);
      for (int node = fiber.first_node; node < fiber.first_node + fiber.n_nodes(); ++node, row += 3) {
        const Eigen::Vector3d arm = to_eigen(position[node]) - center;
        motions.block<3, 3>(row, column).setIdentity();
        motions.block<3, 1>(row, column + 3) = first.cross(arm);
        motions.block<3, 1>(row, column + 4) = second.cross(arm);
      }
      column += 5;
    }
    Eigen::VectorXd others = f;  // of nodes that are of no rigid fiber
    for (const int r : rows) others[r] = 0.0;
    const Eigen::VectorXd known = background + mobility * others;
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(m + 5 * n_bodies, m + 5 * n_bodies);
    Eigen::VectorXd right(m + 5 * n_bodies), loads(m);
    for (int a = 0; a < m; ++a) {
      for (int b = 0; b < m; ++b) system(a, b) = mobility(rows[a], rows[b]);
      right[a] = -known[rows[a]];
      loads[a] = f[rows[a]];
    }
    system.topRightCorner(m, 5 * n_bodies) = -motions;
    system.bottomLeftCorner(5 * n_bodies, m) = motions.transpose();
    right.tail(5 * n_bodies) = motions.transpose() * loads;
    const Eigen::VectorXd solution = system.partialPivLu().solve(right);
    Eigen::VectorXd all = others;
    for (int a = 0; a < m; ++a) all[rows[a]] = solution[a];
    const Eigen::VectorXd u = background + mobility * all;
    for (int i = 0; i < n; ++i) {
      velocity.push_back({u[3 * i], u[3 * i + 1], u[3 * i + 2]});
      force.push_back({all[3 * i], all[3 * i + 1], all[3 * i + 2]});
    }
  }
};

}  // namespace skein::dense
