#pragma once

#include <skein/analysis/force_moments.hpp>
#include <skein/core/vec3.hpp>

#include <optional>
#include <span>
#include <vector>

namespace skein {

/// What angles of fibers count from.
enum class AngleOrigin {
  flow,             ///< the direction of the flow, in the plane in which it turns fibers
  first_direction,  ///< in that plane, the fiber's own direction at first: a rotation has no direction of flow
  strain_axis,      ///< the axis of a flow without vorticity along which it strains most
  own_direction,    ///< the fiber's own direction at first, in space: the fluid is at rest
};
const char* name_of(AngleOrigin origin);

/// The directions that a flow has of itself, whatever the axes of space; all of length 1.
///
/// A flow with vorticity turns fibers clockwise about `normal`, in the plane of `along` and `gradient`. In a shear,
/// velocities lie along `along` and grow with `gradient`; in another flow `along` is where a shear would have it: at 45
/// degrees clockwise from the axis of extension. Half a turn about the normal changes neither a shear nor a fiber, so
/// that `along` may point either way.
struct FlowFrame {
  AngleOrigin angle_origin = AngleOrigin::own_direction;
  Vec3 along;     ///< zero where the flow has no such direction
  Vec3 gradient;  ///< normal x along
  /// Of the plane of the flow: against the vorticity, or across a planar strain, where its sign means nothing; zero
  /// where the flow has no plane.
  Vec3 normal;

  bool turns_fibers() const {
    return angle_origin == AngleOrigin::flow || angle_origin == AngleOrigin::first_direction;
  }
  bool has_plane() const { return norm(normal) > 0.0; }
};

/// @param gradient  of the flow where the fiber is, at its full rate; G_ij = d u_i / d x_j, 1 / time
FlowFrame make_flow_frame(const Matrix3& gradient);

/// The angle of a fiber through time, radians.
///
/// In a flow with vorticity: clockwise about the frame's normal, without jumps, in (-pi/2, pi/2] at first: a fiber has
/// no head. Else: between 0 and pi/2 from the axis of strain, or between 0 and pi from the first direction. Where a
/// fiber has no direction, because its ends meet or it stands across the plane, the angle is that of the moment before.
/// @param end_to_end  [n_moments], length
std::vector<double> measure_angles(const FlowFrame& frame, std::span<const Vec3> end_to_end);

}  // namespace skein
