#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/node_bounds.hpp"

namespace skein {

struct BlobRange {
  double smallest, largest;
};

/// What is to be known of nodes before they are summed.
struct NodeCensus {
  NodeBounds bounds;  ///< length; of what is not a number nothing is seen
  BlobRange blobs;    ///< length
  bool are_finite;    ///< all components of all positions
};

/// Of at least one blob. Waits for the device.
template <class Space>
BlobRange find_blob_range(const Space& space, const ConstScalarView<Space>& blob);

/// True where targets are the sources' own array.
template <class Sources, class Targets>
bool are_same_nodes(const Sources& source, const Targets& target) {
  return source.data() == target.data() && source.extent(0) == target.extent(0);
}

/// One launch, and one wait for the device.
/// @param source, target  [n, 3], length; the same array where the sources are the targets
/// @param blob            [n_sources], length; or empty: its range is then that of no numbers
template <class Space>
NodeCensus take_census(const Space& space, const ConstVectorView<Space>& source, const ConstVectorView<Space>& target,
                       const ConstScalarView<Space>& blob);

}  // namespace skein
