#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/tube_surface.hpp"

namespace skein {

struct NodesInside {
  int count = 0;
  double depth = 0.0;  ///< the greatest, length
};

/// Overwrites depth, [n_nodes], with each node's depth in the surfaces that it sees: those of the other fibers and that
/// of its own fiber where sections are distant from its own (see Fiber::distant_sections). Inside a surface is where
/// its winding number is above 0; the depth is the distance to the surface, the largest one where the node is in
/// several, 0 outside. Waits for the device.
/// @param surfaces  as locate_surfaces left them
template <class Space>
NodesInside compute_penetration(const Space& space, const TubeSurfaces<Space>& surfaces,
                                const ScalarView<Space>& depth);

}  // namespace skein
