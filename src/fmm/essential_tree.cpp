#include "fmm/essential_tree.hpp"

#include "fmm/host_workers.hpp"
#include "fmm/near_matches.hpp"

#include <algorithm>
#include <utility>

// How a rank's part of a tree is made. How it is put together is in essential_assembly.cpp, what is done with its nodes
// and boxes afterwards in essential_moves.cpp.

namespace skein {

void EssentialTree::build(Communicator& ranks, const ConstVectorView<HostSpace>& own, const RankParts& owners,
                          const OctreeRules& rules, HostOctree& tree) {
  rank_ = ranks.rank();
  deal_.build(ranks, own, owners, rules, tree);
  tree.rules = rules;
  tree.cube = deal_.cube();
  split_own(tree.cube);
  const int n_levels = number_tiles(ranks);
  assemble(exchange_lists(ranks, find_essential_boxes(deal_.top(), own_boxes_, rank_, ranks.size(),
                                                      rules.min_sources_for_expansion)),
           n_levels, tree);
  own_boxes_ = {};
  const HostSpace space;
  build_lists(space, tree);
  const double far_pairs = count_far_pairs(tree);
  ask_for_nodes(ranks, tree);
  add_up(ranks, far_pairs, tree);
}

void EssentialTree::split_own(const OctreeCube& cube) {
  const TopTree& top = deal_.top();
  const IndexRange own = deal_.own_places();
  std::vector<int> leaves;
  for (const int leaf : top.leaves)
    if (top.owner[static_cast<std::size_t>(leaf)] == rank_) leaves.push_back(leaf);
  const std::vector<std::uint64_t> keys = deal_.take_keys();
  own_boxes_.below.assign(leaves.size(), {});
  own_boxes_.first_tile.assign(leaves.size(), {});
  for_tasks("skein::EssentialTree::split_own", static_cast<int>(leaves.size()), [&](const int i) {
    const Box& leaf = top.boxes[static_cast<std::size_t>(leaves[static_cast<std::size_t>(i)])];
    const std::span<const std::uint64_t> key(keys);
    own_boxes_.below[static_cast<std::size_t>(i)] =
        split_leaf(cube, leaf,
                   key.subspan(static_cast<std::size_t>(leaf.sources.first - own.first),
                               static_cast<std::size_t>(leaf.sources.count)),
                   leaf.sources.first);
  });
}

/// Of own leaves; in the whole tree those of a level follow each other, and levels do. @returns the number of levels
int EssentialTree::number_tiles(Communicator& ranks) {
  constexpr std::size_t n_most = max_key_depth + 1;
  std::vector<double> told(2 * n_most);  // tiles and boxes below the top, by level
  for (const std::vector<Box>& below : own_boxes_.below)
    for (const Box& box : below) {
      const auto level = static_cast<std::size_t>(box.level);
      if (box.is_leaf()) told[level] += count_tiles(box.sources.count);
      told[n_most + level] += box.parent >= 0 ? 1.0 : 0.0;
    }
  const std::vector<double> all = list_from_all(ranks, told);
  const auto n_ranks = static_cast<std::size_t>(ranks.size());
  std::vector<int> next(n_most);
  int n_before = 0, n_levels = deal_.top().boxes.back().level + 1;
  totals_.n_boxes = static_cast<int>(deal_.top().boxes.size());
  for (std::size_t level = 0; level < n_most; ++level)
    for (std::size_t r = 0; r < n_ranks; ++r) {
      const double* const of_rank = all.data() + 2 * n_most * r;
      if (r == static_cast<std::size_t>(rank_)) next[level] = n_before;
      n_before += static_cast<int>(of_rank[level]);
      if (of_rank[n_most + level] > 0.0) n_levels = math::larger(n_levels, static_cast<int>(level) + 1);
      totals_.n_boxes += static_cast<int>(of_rank[n_most + level]);
    }
  for (std::size_t i = 0; i < own_boxes_.below.size(); ++i)
    for (const Box& box : own_boxes_.below[i]) {
      int& number = next[static_cast<std::size_t>(box.level)];
      own_boxes_.first_tile[i].push_back(number);
      if (box.is_leaf()) number += count_tiles(box.sources.count);
    }
  return n_levels;
}

/// While boxes have places in the order of all nodes: each is counted by the rank that has its first node.
double EssentialTree::count_far_pairs(const HostOctree& tree) const {
  double far_pairs = 0.0;
  for (int b = 0; b < tree.n_boxes(); ++b)
    if (overlap({tree.box(b).sources.first, 1}, deal_.own_places()))
      far_pairs += static_cast<double>(tree.v_list.of(b).size());
  return far_pairs;
}

void EssentialTree::add_up(Communicator& ranks, const double far_pairs, HostOctree& tree) {
  std::vector<Box> leaves;
  for (int b = 0; b < tree.n_boxes(); ++b) {
    const Box& box = tree.box(b);
    if (box.is_leaf() && owner_[static_cast<std::size_t>(b)] == rank_) leaves.push_back(box);
  }
  own_leaves_ = Kokkos::View<Box*, HostSpace>("skein::EssentialTree::own_leaves", leaves.size());
  std::copy(leaves.begin(), leaves.end(), own_leaves_.data());
  const std::vector<double> all = list_from_all(
      ranks, {tree.n_near_pairs, far_pairs, static_cast<double>(tree.n_target_leaves), tree.largest_leaf});
  totals_.near_pairs = totals_.far_pairs = 0.0;
  totals_.n_leaves = 0;
  for (std::size_t i = 0; i < all.size(); i += 4) {
    totals_.near_pairs += all[i];
    totals_.far_pairs += all[i + 1];
    totals_.n_leaves += static_cast<int>(all[i + 2]);
    tree.largest_leaf = std::max(tree.largest_leaf, all[i + 3]);
  }
}

}  // namespace skein
