#pragma once

#include <skein/scene/scene_config.hpp>

namespace skein {

/// The chord 2 R sin(pi / N_c) between neighbouring nodes of a section. Length
double compute_node_spacing(const FiberConfig& fiber);

/// Between neighbouring sections: what the scene says, or that chord. Length
double compute_section_spacing(const FiberConfig& fiber);

/// The nodes of a chain in the stead of the tube that the keys describe: a spacing apart that fills the tube's length,
/// the nodes on its centreline. A fiber that stands for no tube comes back as it is; blob and stiffness are left alone,
/// see resolve_chains.
FiberConfig lay_out_chain(const FiberConfig& fiber);

/// All fibers of a scene, laid out: for whoever counts nodes.
SceneConfig lay_out_chains(SceneConfig scene);

}  // namespace skein
