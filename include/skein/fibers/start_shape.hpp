#pragma once

#include <skein/core/vec3.hpp>
#include <skein/fibers/fiber.hpp>

#include <cstdint>
#include <vector>

namespace skein {

/// Orthonormal and right-handed: along a fiber, and from its centreline to angle 0 and 90 degrees of a section.
struct FiberAxes {
  Vec3 along, angle_0, angle_90;
};

/// The axes x, y, z under the smallest rotation that takes x to the direction, then rolled about the direction.
/// This is continuous in the direction except at -x, where no choice is continuous for all neighbours (a sphere has no
/// continuous tangent field): there the axes are (-x, -y, z), the limit of turning within the x-y plane.
FiberAxes make_fiber_axes(Vec3 direction, double roll_degrees);

/// Where a section stands at the start.
struct SectionPose {
  Vec3 center;
  FiberAxes axes;  ///< `along` is perpendicular to the section
};

/// Adds the nodes of a section. @param nodes  length
void append_section_nodes(const FiberConfig& config, const SectionPose& section, std::vector<Vec3>& nodes);

/// Sections of a fiber at the start: a helix where that is its rest shape, straight, or bent by start_amplitude and
/// start_noise. A bent fiber keeps its length (neighbouring sections are a spacing apart) and its circular sections,
/// which stay perpendicular to its centreline. The slope of the centreline against the fiber's direction is that of a
/// sine for each bend; that of start_mode is as steep as brings a section start_amplitude L away from the line through
/// the ends.
/// @param seed  of the random bends, with the fiber's index
/// @returns [fiber.config.sections]
/// @throws Error(scene_error) where no slope reaches the amplitude, see find_start_problems
std::vector<SectionPose> make_section_poses(const Fiber& fiber, std::uint64_t seed);

/// Sections that a half wave of a bend needs to be seen by.
inline constexpr int sections_per_half_wave = 4;

/// What the bends add at most to the distance of the centreline from the straight one. Length
double bound_start_deflection(const Fiber& fiber);

}  // namespace skein
