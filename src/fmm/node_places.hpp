#pragma once

#include "kernels/index_range.hpp"

#include <vector>

namespace skein {

/// Where a rank has some of all nodes: places in the order of all, and places here, in the same order. Place 0 is
/// nobody's, so that there is one.
class NodePlaces {
 public:
  NodePlaces() = default;
  /// @param runs  of places in the order of all; they may overlap
  explicit NodePlaces(std::vector<IndexRange> runs);

  int n_places() const { return next_; }
  /// Place here of nodes that are all here; {0, count} where they are not.
  IndexRange find(IndexRange of_all) const;
  /// What there is between two places of all, in pieces.
  std::vector<IndexRange> list_between(IndexRange of_all) const;

 private:
  struct Piece {
    IndexRange of_all;
    int first = 0;
  };
  std::vector<Piece> pieces_;
  int next_ = 1;
};

}  // namespace skein
