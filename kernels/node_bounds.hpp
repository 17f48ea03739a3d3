#pragma once

#include <limits>

namespace skein {

/// A box along the axes, length. Empty until nodes have widened it.
struct NodeBounds {
  static constexpr double most = std::numeric_limits<double>::max();
  double low[3] = {most, most, most}, high[3] = {-most, -most, -most};
};

}  // namespace skein
