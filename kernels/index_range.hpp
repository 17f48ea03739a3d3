#pragma once

#include <skein/core/math.hpp>

namespace skein {

/// The indices [first, first + count), of nodes or boxes.
struct IndexRange {
  int first = 0;
  int count = 0;
};

/// The indices that both have.
SKEIN_INLINE_FUNCTION IndexRange common(const IndexRange& a, const IndexRange& b) {
  const int first = math::larger(a.first, b.first), end = math::smaller(a.first + a.count, b.first + b.count);
  return {first, math::larger(0, end - first)};
}

/// True where ranges share an index.
SKEIN_INLINE_FUNCTION bool overlap(const IndexRange& a, const IndexRange& b) { return common(a, b).count > 0; }

}  // namespace skein
