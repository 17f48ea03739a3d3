#pragma once

#include <skein/ranks/communicator.hpp>

#include "fmm/octree.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace skein {

/// The upper boxes of a tree over the nodes of all ranks, which every rank has: split as the whole tree is, but for
/// boxes of so few nodes that they go to one rank each. Their sources and targets are places in the order of all nodes.
struct TopTree {
  static constexpr int several = -1;  ///< ranks

  std::vector<Box> boxes;       ///< level by level
  std::vector<int> owner;       ///< per box, the rank of all its nodes, or several
  std::vector<int> leaves;      ///< boxes that are not split here, in the order of their nodes
  std::vector<int> first_node;  ///< [n_ranks + 1], places in the order of all nodes: where each rank's begin
  double balance = 1.0;         ///< the largest work of a rank over the mean
};

/// The own nodes of a rank by key.
struct SortedKeys {
  std::span<const std::uint64_t> key;
  std::span<const double> work_before;  ///< [n + 1], of the nodes before each, in any unit
};

/// A box's key at the depth of all keys: that of its first cell.
std::uint64_t first_key(const Box& box, int max_depth);

/// To be called by all ranks. Consecutive leaves go to ranks, so that each has about as much work.
/// @param cube  the same on all ranks  @param n_nodes  of all ranks
TopTree make_top_tree(Communicator& ranks, const OctreeCube& cube, const SortedKeys& own, int n_nodes);

/// The boxes below a leaf of the top tree, all of whose nodes are here: level by level, parents before, and the leaf
/// itself first. Parents and children are places in what is returned. @param first_node  place of the first key
std::vector<Box> split_leaf(const OctreeCube& cube, const Box& leaf, std::span<const std::uint64_t> key,
                            int first_node);

}  // namespace skein
