#pragma once

#include <skein/fibers/fiber.hpp>

#include <vector>

namespace skein {

/// How a straight rigid line of nodes alone in the fluid answers flows and loads, in its own frame: what is along the
/// line and what is across it do not mix. Nodes at `place` move with the velocity U + place w, w across the line; by
/// the resistance R, the inverse of the line's mobility:
///
///   U = sum of share u over all nodes, share = slide along the line and shift across it;  w = sum of turn u
///
/// is the motion without a load in a flow that would carry its nodes with the velocities u, and slide, shift and turn
/// are also how a load spreads over the nodes: the force F and the moment m, the sum of place f across the line, become
/// share F + turn m, under which the line moves without a change of shape.
struct RigidLine {
  std::vector<double> place;         ///< [n_nodes], from the line's middle, length
  std::vector<double> slide, shift;  ///< [n_nodes]
  std::vector<double> turn;          ///< [n_nodes], 1 / length
  std::vector<double> across;        ///< [n_nodes, n_nodes], R across the line, force * time / length
  std::vector<double> along_excess;  ///< [n_nodes, n_nodes], R along the line less that across it
};

/// Takes n_nodes^3 operations.
/// @param fiber  rigid
/// @throws Error(scene_error) where the blob is so large against the nodes' distance that rounding decides the forces
RigidLine make_rigid_line(const Fiber& fiber, double viscosity);

}  // namespace skein
