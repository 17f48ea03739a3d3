#pragma once

#include "fmm/top_tree.hpp"

#include <cstdint>
#include <vector>

namespace skein {

/// A box as ranks tell each other of it: its sources are places in the order of all nodes.
struct BoxRecord {
  int level = 0;
  int cell[3] = {};
  IndexRange sources;
  int first_tile = 0;  ///< of a leaf: number among the tiles of all leaves
  int is_split = 0;    ///< it is none
};

/// A box by its place in space.
struct CellName {
  int level = 0;
  int cell[3] = {};
};

/// The boxes of a rank below the leaves of the top tree that are its own.
struct OwnBoxes {
  std::vector<std::vector<Box>> below;  ///< per own leaf of the top tree, as split_leaf makes them
  std::vector<std::vector<int>>
      first_tile;  ///< the same: of leaves, the number of their first tile among those of all ranks
};

/// What each rank needs to know of this one's boxes for the lists of its own targets: those whose parents touch what is
/// another's, down to where none does. Entry r is for rank r; own is empty.
/// @param min_sources  boxes of fewer are never expanded
std::vector<std::vector<BoxRecord>> find_essential_boxes(const TopTree& top, const OwnBoxes& own, int rank, int n_ranks,
                                                         int min_sources);

}  // namespace skein
