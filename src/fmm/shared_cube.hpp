#pragma once

#include <skein/ranks/communicator.hpp>

#include "fmm/octree.hpp"

namespace skein {

/// To be called by all ranks: the cube that choose_cube finds for the nodes of all of them, which nobody needs to have.
/// @param own  [nodes.count[rank], 3], length: the nodes of this rank  @param nodes  of all ranks
OctreeCube choose_shared_cube(Communicator& ranks, const ConstVectorView<HostSpace>& own, const RankParts& nodes,
                              const OctreeRules& rules, HostOctree& memory);

}  // namespace skein
