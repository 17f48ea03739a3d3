#pragma once

#include <skein/scene/scene_config.hpp>

namespace skein {

/// The chord 2 R sin(pi / N_c) between neighbouring nodes of a section. Length
double compute_node_spacing(const FiberConfig& fiber);

/// Between neighbouring sections: what the scene says, or that chord. Length
double compute_section_spacing(const FiberConfig& fiber);

}  // namespace skein
