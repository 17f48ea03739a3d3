#pragma once

#include <Eigen/Dense>

namespace skein {

/// Velocities over forces of the nodes of a straight line in a fluid of viscosity 1: forces along the line cause
/// velocities along it only, and forces across it velocities across it. Both are [n_nodes, n_nodes], symmetric,
/// 1 / (viscosity * length).
struct LineMobility {
  Eigen::MatrixXd along, across;
};

/// @param spacing, blob  length
LineMobility make_line_mobility(int n_nodes, double spacing, double blob);

/// Places of the nodes along the line, from its middle. @returns [n_nodes], length
Eigen::VectorXd list_line_places(int n_nodes, double spacing);

}  // namespace skein
