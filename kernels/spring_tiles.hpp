#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/spring_force.hpp"

namespace skein {

/// add_spring_force and add_spring_force_change on a host, several sections of a fiber at once: for fibers of which
/// none has sections too wide for a tile, and for one node at least.
void add_spring_force_by_tiles(const HostSpace& space, const SpringArrays<HostSpace>& springs, IndexRange nodes,
                               const ConstVectorView<HostSpace>& position, const VectorView<HostSpace>& force);
void add_spring_force_change_by_tiles(const HostSpace& space, const SpringArrays<HostSpace>& springs, IndexRange nodes,
                                      const ConstVectorView<HostSpace>& position,
                                      const ConstVectorView<HostSpace>& displacement,
                                      const VectorView<HostSpace>& change);

}  // namespace skein
