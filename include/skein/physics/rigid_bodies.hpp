#pragma once

#include <skein/arrays/types.hpp>
#include <skein/fibers/fiber.hpp>

#include <memory>
#include <vector>

namespace skein {

struct RigidLineArrays;

/// Where the rigid fibers of a scene are.
struct RigidPoses {
  Vectors center;  ///< [n_bodies], length
  Vectors axis;    ///< [n_bodies], of length 1, from the first node to the last
};

/// The rigid fibers of a scene, each as if it were alone in the fluid: its motion in a flow, the spread of its loads
/// and the forces that keep it rigid are linear in the flow and the load, by resistances that are found once (see
/// RigidLine). What fibers do to each other is left to the caller. A line's spin about itself is not seen, and is zero.
///
/// All arrays are [n_nodes, 3], of all fibers; nodes of other fibers are left alone. Results do not depend on the
/// number of threads. One call at a time: the object holds scratch.
class RigidBodies {
 public:
  /// Fibers alike share their resistance. @throws Error(scene_error) where a fiber's blob is too large for its nodes
  RigidBodies(const std::vector<Fiber>& fibers, double viscosity);
  ~RigidBodies();
  RigidBodies(RigidBodies&&) noexcept;
  RigidBodies& operator=(RigidBodies&&) noexcept;

  bool is_empty() const { return n_bodies_ == 0; }

  /// The largest force on a node over its own velocity while the others of its fiber rest: what a velocity's rounding
  /// is worth. Force * time / length
  double stiffest_drag() const;
  RigidPoses make_poses() const;

  /// Overwrites poses with the least-squares fit to the positions, length.
  void compute_poses(const ConstVectors& position, const RigidPoses& poses) const;

  /// Overwrites the positions of the fibers' nodes with those on the poses.
  void place(const RigidPoses& poses, const Vectors& position) const;

  /// Puts in the place of each fiber's forces those of the same sum and torque about axes across it under which it
  /// moves as a rigid body.
  void spread_loads(const RigidPoses& poses, const Vectors& force) const;

  /// Adds the forces that keep each fiber rigid in a flow that would carry its nodes with these velocities. They have
  /// neither sum nor torque.
  void add_constraint_forces(const RigidPoses& poses, const ConstVectors& velocity, const Vectors& force) const;

  /// Puts in the place of each fiber's velocities those of the rigid body's motion in such a flow.
  void make_rigid(const RigidPoses& poses, const Vectors& velocity) const;

  /// Overwrites result with the vectors of the rigid fibers' nodes, and zeros elsewhere.
  void compute_share(const ConstVectors& vectors, const Vectors& result) const;

 private:
  int n_bodies_ = 0;
  std::unique_ptr<RigidLineArrays> lines_;
};

}  // namespace skein
