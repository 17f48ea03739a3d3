#pragma once

#include <skein/scene/scene_config.hpp>

#include <vector>

namespace skein {

/// The factor at a position: straight lines between the points, constant beyond them.
/// @param profile   at least one point, positions growing
/// @param position  0 at a fiber's first section, 1 at its last
double interpolate(const std::vector<ProfilePoint>& profile, double position);

}  // namespace skein
