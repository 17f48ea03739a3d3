#pragma once

#include <skein/arrays/types.hpp>

namespace skein {

struct BlobRange {
  double smallest, largest;
};

/// Of at least one blob. Waits for the device.
template <class Space>
BlobRange find_blob_range(const Space& space, const ConstScalarView<Space>& blob);

/// True where targets are the sources' own array.
template <class Sources, class Targets>
bool are_same_nodes(const Sources& source, const Targets& target) {
  return source.data() == target.data() && source.extent(0) == target.extent(0);
}

/// False where any component is infinite or not a number. Waits for the device.
template <class Space>
bool are_finite(const Space& space, const ConstVectorView<Space>& vectors);

}  // namespace skein
