#pragma once

namespace skein {

/// A run of nodes [first, first + count).
struct Run {
  int first = 0;
  int count = 0;
};

}  // namespace skein
