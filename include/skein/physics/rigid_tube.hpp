#pragma once

#include <skein/fibers/fiber.hpp>

namespace skein {

/// How a straight rigid tube of nodes meets the fluid: forces and torques about its middle, of which no motion of one
/// kind causes another kind's.
struct RigidTubeDrag {
  double axial = 0.0;       ///< force per velocity along the tube, force * time / length
  double transverse = 0.0;  ///< ... and across it
  double turning = 0.0;     ///< torque per angular velocity about an axis across the tube, force * length * time
  double spinning = 0.0;    ///< ... and about its own axis
  /// Torque on the tube held fixed, per rate of shear, where velocities lie across the tube and grow along it, and
  /// where they lie along it and grow across it: this one is a couple on the surface, which a line does not feel.
  double torque_across = 0.0, torque_along = 0.0;  ///< force * length * time

  /// torque_along on a length of the tube's middle: the couple on its surface, and the forces across the tube nearer to
  /// its end. The rest of torque_along sits at the ends. Force * time
  double couple_within = 0.0;

  /// Of the ellipsoid that turns alike in a shear (Jeffery 1922; Cox, J. Fluid Mech. 45, 625 (1971)).
  double effective_aspect_ratio() const;
};

/// Solves for the forces on the nodes that give them the velocities of a rigid body, by regularized Stokeslets in
/// double. All nodes of a section take part alike, but for the cosine of their angle, so that there are 3 N_f unknowns
/// for the motions across and 2 N_f for those along, whatever N_c. Takes (3 N_f)^3 / 3 operations: 0.1 s for 300
/// sections. Bends, profiles and place of the fiber do not matter.
/// @param fiber  3 nodes on a section at least
/// @throws Error(scene_error) where the blob is so large against the nodes' distance that rounding decides the forces
RigidTubeDrag measure_rigid_tube(const Fiber& fiber, double viscosity);

}  // namespace skein
