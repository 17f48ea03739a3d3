#pragma once

#include <skein/fibers/start_shape.hpp>

#include <vector>

namespace skein {

/// Sections of a fiber whose rest shape is a helix (FiberConfig::helix_radius): the first where that of the straight
/// fiber stands, from there a shaft along the fiber's direction, then the distance r from this axis rises as
/// helix_radius (1 - exp(-(x / helix_taper)^2)) over the length x along it, by (r cos, r sin) of 2 pi x / helix_pitch
/// towards angles 0 and 90 (J. J. L. Higdon, J. Fluid Mech. 94, 331 (1979), tapers so). Neighbouring sections are a
/// spacing apart and perpendicular to the centreline; none is twisted against the one before.
/// @returns [fiber.config.sections]
std::vector<SectionPose> make_helix(const Fiber& fiber);

/// How the fiber at rest bends from a section to one `offset` further on: chord (1 - curvature . place) is the distance
/// of nodes along it. 1 / length, towards angles 0 and 90.
struct RestBend {
  double towards_0 = 0.0, towards_90 = 0.0;
};
RestBend measure_rest_bend(const SectionPose& first, const SectionPose& second, double length);

}  // namespace skein
