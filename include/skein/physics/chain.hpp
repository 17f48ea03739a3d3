#pragma once

#include <skein/scene/scene_config.hpp>

namespace skein {

/// What a chain, or a rigid fiber, takes over from the tube in whose stead it stands, and how well it does.
struct ChainMatch {
  double blob = 0.0;          ///< with which the straight chain is turned against as much drag as the tube, length
  double shear_couple = 0.0;  ///< on a length of its middle that lies along a shear, over its rate, force * time
  double end_couple = 0.0;    ///< at each end beside it, so that all together are the tube's, force * length * time
  double transverse = 0.0;    ///< the chain's drag across itself over the tube's
  double axial = 0.0;         ///< ... and along itself
};

/// From rigid tubes and rigid chains in double. Of long tubes a piece of 320 sections, or 120 radii, is looked at: what
/// lies farther apart adds nothing to blob and couple.
/// @param fiber  a chain or a rigid fiber that stands for a tube
/// @throws Error(scene_error) where the tube's blob is too large, the tube too short, or no blob of the chain matches
/// it
ChainMatch match_chain(const FiberConfig& fiber, double viscosity);

/// The scene with every chain and rigid fiber that stands for a tube turned into one with numbers of its own: nodes a
/// spacing apart along the tube's centreline, EI and EA of the tube at equilibrium, blob and couple of match_chain. A
/// run folder's scene is such a one. Others come back as they are.
/// @throws Error(scene_error) as match_chain does, with the fiber's number
SceneConfig resolve_chains(const SceneConfig& scene);

}  // namespace skein
