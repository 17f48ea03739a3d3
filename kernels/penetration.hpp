#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/tube_surface.hpp"

namespace skein {

/// Launches a search for nodes inside of the surfaces that they see: those of the other fibers and that of their own
/// fiber where sections are distant from theirs (see Fiber::distant_sections). Inside a surface is where its winding
/// number is above 0. Overwrites depth, [n_nodes], with the distance to the surface, the largest one where a node is in
/// several, 0 outside; length. Does not wait for the device.
/// @param surfaces  as locate_surfaces left them
/// @param n_inside  nodes; there after the next wait
template <class Space>
void seek_nodes_inside(const Space& space, const TubeSurfaces<Space>& surfaces, const ScalarView<Space>& depth,
                       const FoundNumber& n_inside);

/// The largest of some depths. Waits for the device.
template <class Space>
double find_largest_depth(const Space& space, const ScalarView<Space>& depth);

}  // namespace skein
