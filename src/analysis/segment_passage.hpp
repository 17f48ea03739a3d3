#pragma once

#include <skein/core/vec3.hpp>

namespace skein {

/// A straight piece of a centreline between two moments; its ends move straight.
struct MovingPiece {
  Vec3 first_before, last_before, first_after, last_after;  ///< length

  /// @param share  of the time between the moments
  Vec3 first(const double share) const { return first_before + share * (first_after - first_before); }
  Vec3 last(const double share) const { return last_before + share * (last_after - last_before); }
};

/// Length
double compute_distance(const MovingPiece& p, const MovingPiece& q, double share);

/// What two pieces do to each other between the moments.
struct PieceEncounter {
  bool rises = false, falls = false;  ///< they pass through each other, and the volume below grows or shrinks
  bool is_planar = false;             ///< one plane holds both at both moments: nothing passes through anything
};

/// Passages are moments at which both pieces lie in one plane and meet in it: roots of the volume that they span,
/// (last - first of p) . ((last - first of q) x (first of q - first of p)), a cubic in time.
/// @param meeting  pieces as near as this meet, length
PieceEncounter find_passages(const MovingPiece& p, const MovingPiece& q, double meeting);

/// True where the pieces come nearer than half of the distance at some time between the moments, false where they do
/// not come as near as it.
bool come_near(const MovingPiece& p, const MovingPiece& q, double distance);

}  // namespace skein
