#pragma once

#include <skein/core/math.hpp>

#include "kernels/index_range.hpp"

#include <vector>

// How the sum in which each pair of nodes is weighed once is divided for several processes, so that nothing of its
// order depends on how many there are. Nodes are cut into tiles; in round 0 each tile plays alone, in each other round
// of a tournament every tile meets another one. Rounds are the leaves of a binary tree: what a round contributes to all
// nodes is summed by itself, and the contributions are added up along the tree.

namespace skein {

/// Rounds [index 2^level, (index + 1) 2^level), as far as there are such: a node of the tree.
struct RoundBlock {
  int level = 0, index = 0;
  bool operator==(const RoundBlock&) const = default;
};

struct PairRounds {
  static constexpr int nodes_per_tile = 32;  // aimed at; many nodes make most_tiles larger ones
  static constexpr int most_tiles = 64;

  int n_tiles = 0;  ///< even, and as many rounds

  explicit PairRounds(const int n_nodes)
      : n_tiles(math::larger(2, math::smaller(most_tiles, n_nodes / nodes_per_tile / 2 * 2))) {}

  /// Level of the block that holds all rounds.
  int top_level() const;
  bool has_second_half(const RoundBlock& block) const {
    return block.level > 0 && (2 * block.index + 1) << (block.level - 1) < n_tiles;
  }

  /// Consecutive rounds for each of some processes: as much work for each as can be, round 0 being half of another.
  std::vector<IndexRange> share(int n_processes) const;

  /// The largest blocks that make up some consecutive rounds.
  std::vector<RoundBlock> list_blocks(IndexRange rounds) const;
};

}  // namespace skein
