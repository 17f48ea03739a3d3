#pragma once

#include <skein/core/math.hpp>

namespace skein {

/// The indices [first, first + count), of nodes or boxes.
struct IndexRange {
  int first = 0;
  int count = 0;
};

/// True where ranges share an index.
SKEIN_INLINE_FUNCTION bool overlap(const IndexRange& a, const IndexRange& b) {
  return a.count > 0 && b.count > 0 && a.first < b.first + b.count && b.first < a.first + a.count;
}

}  // namespace skein
