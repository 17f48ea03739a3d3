#pragma once

#include <skein/core/types.hpp>

namespace skein {

struct BlobRange {
  double smallest, largest;
};

/// Of at least one blob. Waits for the device.
template <class Space>
BlobRange find_blob_range(const Space& space, const ConstScalarView<Space>& blob);

/// False where any component is infinite or not a number. Waits for the device.
template <class Space>
bool are_finite(const Space& space, const ConstVectorView<Space>& vectors);

}  // namespace skein
