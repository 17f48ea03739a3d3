#pragma once

#include "fmm/rank_shares.hpp"
#include "kernels/ordered_matches.hpp"

#include <vector>

namespace skein {

/// Who meets whom in the near field of nodes that are sources and targets alike, each pair of nodes once: tiles of
/// leaves, and the order in which they meet.
///
/// In the packed order, nodes stand as in the tree, with places left free behind the last of each leaf: all tiles begin
/// at a multiple of tile_step. Tiles that meet nobody have no places.
struct NearMatches {
  std::vector<IndexRange> tiles;  ///< in the order of the tree
  std::vector<Match> matches;
  std::vector<int> packed_first;  ///< per tile its first place in the packed order; at the end, the number of places
  std::vector<int> leaf_first;    ///< per target leaf its first place in the packed order

  std::vector<int> met;  ///< tiles that are in a match
  Lists<IndexRange, HostSpace>
      one_way;  ///< per target leaf: sources in boxes that are not leaves, which it only receives from

  int n_packed() const { return packed_first.back(); }
};

/// @param tree    of nodes that are sources and targets alike; or a rank's part of one, where boxes of others have no
///                targets
/// @param shares  only matches in which a tile has targets of this rank, in the same order; such tiles receive all they
///                would of all matches. Null: all
/// @param first_tile  per box, of a part of a tree: the number of a leaf's first tile among those of the whole; null:
///                    this is the whole
NearMatches make_near_matches(const HostOctree& tree, const RankShares* shares = nullptr,
                              const std::vector<int>* first_tile = nullptr);

/// Into how many tiles a leaf of so many nodes is cut.
int count_tiles(int n_nodes);

}  // namespace skein
