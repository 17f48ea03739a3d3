#pragma once

#include <skein/analysis/flow_frame.hpp>

#include <span>
#include <vector>

namespace skein {

/// Angle of a vector in the plane of a flow, clockwise about the frame's normal from `along`; radians, from -pi to pi.
double compute_clockwise_angle(Vec3 vector, const FlowFrame& frame);

/// Adds full turns so that no angle differs from the one before by more than half a turn.
std::vector<double> unwrap_angles(std::span<const double> angle);

/// Where a fiber first stands at a multiple of a quarter turn from the direction of the flow.
struct Passage {
  double time = 0.0;
  int quarter_turns = 0;  ///< odd: upright to the flow; even: along it
};

/// First passages through all quarter turns but the one the fiber starts at, by linear interpolation.
/// @param angle  unwrapped, radians
std::vector<Passage> find_passages(std::span<const double> time, std::span<const double> angle);

/// Times between successive alignments of the fiber with the flow, either way: half periods. @returns in order; the
/// first one counts from the first moment if the fiber is aligned there.
std::vector<double> find_half_periods(std::span<const double> time, std::span<const double> angle);

}  // namespace skein
