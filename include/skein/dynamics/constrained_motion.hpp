#pragma once

#include <skein/physics/physics.hpp>
#include <skein/solvers/gmres.hpp>

#include <memory>

namespace skein {

/// What a scene's forces and flow make of its nodes in the fluid, where rigid fibers stay rigid: forces g on their
/// nodes with which flow + M g is the velocity of a rigid body, under the sum and the torque of the scene's forces on
/// each. Where no fiber is rigid, velocities are flow + M force.
///
/// Each fiber's own resistance is known (see RigidBodies) and makes the first guess, which is the solution for a fiber
/// that is alone; what fibers do to each other is found by GMRES, preconditioned by it, from nothing but the arguments.
class ConstrainedMotion {
 public:
  /// @param physics  must outlive the object
  explicit ConstrainedMotion(const Physics& physics);

  /// Overwrites places with the positions, [n_nodes, 3], but rigid fibers' nodes put onto the rigid body that fits them
  /// best: where forces, flow and velocities are to be taken. Places may be the positions' own array.
  void compute_places(const ConstVectors& position, const Vectors& places) const;

  /// @param places    as above
  /// @param force     of the scene; on rigid fibers it is replaced by that of the nodes on the fluid
  /// @param velocity  of the flow at the places; replaced by that of the nodes
  /// @throws Error(numerical) where the forces are not found
  void solve(const ConstVectors& places, const Vectors& force, const Vectors& velocity);

  /// Overwrites force with that of the nodes on the fluid, in the scene's flow and under its forces.
  void compute_forces(double time, const ConstVectors& places, const Vectors& force);

 private:
  void add_interaction(const ConstVectors& places, double tolerance, const Vectors& force, const Vectors& velocity);

  const Physics& physics_;
  RigidPoses poses_;
  Vectors residual_, correction_, induced_;  ///< [n_nodes, 3]
  std::unique_ptr<Gmres> gmres_;             ///< null where no fiber is rigid
};

}  // namespace skein
