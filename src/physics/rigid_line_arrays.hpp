#pragma once

#include <skein/arrays/types.hpp>
#include <skein/fibers/fiber.hpp>

#include <cstdint>
#include <vector>

namespace skein {

/// A rigid fiber among all nodes, and where its line's numbers begin.
struct RigidBody {
  int first_node = 0, n_nodes = 0;
  int first_entry = 0;  ///< of place, slide, shift and turn
  std::int64_t first_entry_of_matrix = 0;

  KOKKOS_INLINE_FUNCTION int entry_of(const int node) const { return first_entry + node - first_node; }
};

/// A rigid body's velocity at the places of its nodes, or a load in the same coordinates.
struct BodyVectors {
  Vec3 of_middle, per_place;
};

KOKKOS_INLINE_FUNCTION Vec3 part_across(const Vec3 axis, const Vec3 v) { return v - dot(axis, v) * axis; }

/// The lines of all kinds of fibers on the device, one after the other.
struct RigidLineArrays {
  Kokkos::View<RigidBody*, ExecSpace> body;    ///< [n_bodies]
  Kokkos::View<int*, ExecSpace> body_of_node;  ///< [n_nodes], -1 of nodes that are of no rigid fiber
  ConstScalars place, slide, shift, turn;      ///< see RigidLine, as the next
  ConstScalars across, along_excess;
  double stiffest_drag = 0.0;
  Vectors of_middle, per_place;  ///< [n_bodies], scratch: BodyVectors

  /// U and w of the motion in a flow that would carry the nodes with these velocities.
  KOKKOS_INLINE_FUNCTION BodyVectors motion_in(const RigidBody& b, const Vec3 axis,
                                               const ConstVectors& velocity) const {
    Vec3 sliding, shifting, turning;
    for (int node = b.first_node; node < b.first_node + b.n_nodes; ++node) {
      const int entry = b.entry_of(node);
      const Vec3 u = load(velocity, node);
      sliding = sliding + slide(entry) * u;
      shifting = shifting + shift(entry) * u;
      turning = turning + turn(entry) * u;
    }
    return {dot(axis, sliding) * axis + part_across(axis, shifting), part_across(axis, turning)};
  }
  /// Sum and moment of forces.
  KOKKOS_INLINE_FUNCTION BodyVectors load_of(const RigidBody& b, const Vec3 axis, const ConstVectors& force) const {
    BodyVectors sum;
    for (int node = b.first_node; node < b.first_node + b.n_nodes; ++node) {
      const Vec3 f = load(force, node);
      sum.of_middle = sum.of_middle + f;
      sum.per_place = sum.per_place + place(b.entry_of(node)) * f;
    }
    return {sum.of_middle, part_across(axis, sum.per_place)};
  }
};

/// @throws Error(scene_error) as make_rigid_line does
RigidLineArrays make_rigid_line_arrays(const std::vector<Fiber>& fibers, double viscosity);

}  // namespace skein
