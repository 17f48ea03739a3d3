#pragma once

namespace skein {

/// The indices [first, first + count), of nodes or boxes.
struct IndexRange {
  int first = 0;
  int count = 0;
};

}  // namespace skein
