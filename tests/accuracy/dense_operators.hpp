#pragma once

#include <skein/core/vec3.hpp>
#include <skein/scene/scene_config.hpp>

#include <Eigen/Dense>

#include <vector>

// The linear operators of a straight fiber along x as dense matrices, from the formulas alone: no kernel, no fiber and
// no spring network of the library is used. Node a of section s has the index s N_c + a; a node's components follow
// each other in vectors of 3 n_nodes.

namespace skein::dense {

using Points = std::vector<Eigen::Vector3d>;

/// Nodes of the straight fiber about the origin: N_f sections of N_c nodes, spaced by the chord.
Points make_straight_tube(const FiberConfig& config);

/// Velocity at d from a node per force on it: regularized Stokeslet.
Eigen::Matrix3d mobility_block(const Eigen::Vector3d& d, double blob, double viscosity);

/// [3 n, 3 n]
Eigen::MatrixXd make_mobility(const Points& points, double blob, double viscosity);

/// Hessian block of a spring at rest between two nodes d apart: the force on one per displacement of the other.
Eigen::Matrix3d spring_block(const Eigen::Vector3d& d, double stiffness);

/// Hessian of the elastic energy about the straight fiber, [3 n, 3 n]: force = -K displacement.
Eigen::MatrixXd make_stiffness(const FiberConfig& config);

/// Displacements of nodes at rest on sections i: x along the fiber, then outwards, then along growing angle.
Eigen::Matrix3d section_frame(double angle);

/// One angular mode m of an operator that is the same for every node of a section: for displacements
/// section_frame(angle) v_s exp(i m angle) of node (s, angle) it acts on v, [3 N_f].
/// @param row_block  (section, other section, other node) -> block of node 0 of `section` and that node
template <class RowBlock>
Eigen::MatrixXcd make_angular_mode(const FiberConfig& config, const int mode, const RowBlock& row_block) {
  const int n = config.nodes_per_section;
  Eigen::MatrixXcd operator_of_mode = Eigen::MatrixXcd::Zero(3 * config.sections, 3 * config.sections);
  for (int b = 0; b < n; ++b) {
    const double angle = 2.0 * EIGEN_PI * b / n;
    const std::complex<double> phase = std::polar(1.0, mode * angle);
    const Eigen::Matrix3d frame = section_frame(angle);
    for (int s = 0; s < config.sections; ++s)
      for (int t = 0; t < config.sections; ++t) {
        const Eigen::Matrix3d block = section_frame(0.0).transpose() * row_block(s, t, b) * frame;
        operator_of_mode.block<3, 3>(3 * s, 3 * t) += phase * block;
      }
  }
  return operator_of_mode;
}
Eigen::MatrixXcd make_mobility_mode(const FiberConfig& config, double viscosity, int mode);
Eigen::MatrixXcd make_stiffness_mode(const FiberConfig& config, int mode);

}  // namespace skein::dense
