#pragma once

#include <skein/core/vec3.hpp>

namespace skein {

/// Smallest distance between two straight pieces, from a to b and from c to d; either may be a point. Length
double compute_segment_distance(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

}  // namespace skein
