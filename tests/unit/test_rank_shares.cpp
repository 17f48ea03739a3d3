#include "fmm/fmm_operator_set.hpp"
#include "fmm/near_matches.hpp"
#include "fmm/rank_shares.hpp"
#include "tests/reference/point_cloud.hpp"
#include "tests/unit/stokeslet_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

// Every target is one rank's, which has, or is sent, all that its lists ask for.

namespace skein {
namespace {

using reference::Cloud;

struct RankTree {
  HostOctree tree;
  std::vector<std::vector<RankShares>> shares;  ///< [rank counts][rank]
  static constexpr int rank_counts[] = {1, 2, 3, 4, 7, 40};

  RankTree(const Cloud cloud, const int n, const bool same_nodes) {
    reference::Random random(11);
    const HostVectors source = make_host_vectors(reference::make_cloud(cloud, n, {}, 1.0, random));
    const HostVectors target =
        same_nodes ? source : make_host_vectors(reference::make_cloud(Cloud::cube, n / 2, {}, 0.8, random));
    OctreeRules rules;
    rules.leaf_size = 8;
    rules.min_sources_for_expansion = 4;
    tree.build(HostSpace(), source, target, rules);
    for (const int n_ranks : rank_counts) {
      shares.emplace_back();
      for (int rank = 0; rank < n_ranks; ++rank)
        shares.back().push_back(share_tree(tree, FmmPlan{}, same_nodes, rank, n_ranks));
    }
  }
};

template <class Use>
void for_trees(const Use& use) {
  for (const Cloud cloud : {Cloud::cube, Cloud::tube, Cloud::cluster, Cloud::line})
    for (const bool same_nodes : {true, false})
      for (const int n : {3, 700}) use(RankTree(cloud, n, same_nodes));
}

TEST(RankShares, EveryTargetAndEverySourceIsOneRanks) {
  for_trees([](const RankTree& made) {
    for (const auto& of_ranks : made.shares) {
      int next_target = 0, next_source = 0;
      for (const RankShares& shares : of_ranks) {
        ASSERT_EQ(shares.first_target, of_ranks.front().first_target);
        ASSERT_EQ(shares.own_targets().first, next_target);
        ASSERT_EQ(shares.own_sources().first, next_source);
        next_target += shares.own_targets().count;
        next_source += shares.own_sources().count;
      }
      ASSERT_EQ(next_target, made.tree.n_targets);
      ASSERT_EQ(next_source, made.tree.n_sources);
    }
  });
}

TEST(RankShares, WhatIsSentIsWhatIsReceived) {
  for_trees([](const RankTree& made) {
    for (const auto& of_ranks : made.shares)
      for (std::size_t from = 0; from < of_ranks.size(); ++from)
        for (std::size_t to = 0; to < of_ranks.size(); ++to) {
          ASSERT_EQ(of_ranks[from].sent[to], of_ranks[to].received[from]);
          ASSERT_TRUE(from != to || of_ranks[from].sent[to].empty());
        }
  });
}

TEST(RankShares, CoefficientsThatListsAskForAreThere) {
  for_trees([](const RankTree& made) {
    const HostOctree& tree = made.tree;
    for (const auto& of_ranks : made.shares)
      for (const RankShares& shares : of_ranks) {
        std::set<int> there(shares.boxes_of_all.begin(), shares.boxes_of_all.end());
        for (const IndexRange& run : shares.source_boxes)
          for (int b = run.first; b < run.first + run.count; ++b) there.insert(b);
        for (const auto& boxes : shares.received) there.insert(boxes.begin(), boxes.end());
        for (const IndexRange& run : shares.target_boxes)
          for (int b = run.first; b < run.first + run.count; ++b)
            for (const FarPair& pair : tree.v_list.of(b)) ASSERT_TRUE(there.count(pair.source) == 1) << "V";
        for (int leaf = 0; leaf < tree.n_target_leaves; ++leaf) {
          const int b = tree.target_leaves(leaf);
          if (!shares.has_target(tree.box(b).targets.first)) continue;
          const IndexRange run = shares.target_boxes[static_cast<std::size_t>(tree.box(b).level)];
          ASSERT_TRUE(b >= run.first && b < run.first + run.count) << "a leaf of its own";
          for (const int fine : tree.w_list.of(leaf)) ASSERT_TRUE(there.count(fine) == 1) << "W";
        }
        for (const int b : shares.boxes_of_all)
          for (int child = tree.box(b).first_child; child < tree.box(b).first_child + tree.box(b).n_children; ++child)
            ASSERT_TRUE(tree.box(child).sources.count == 0 || there.count(child) == 1) << "M2M";
      }
  });
}

TEST(RankShares, NodesThatAreMetOneByOneAreLookedAt) {
  for_trees([](const RankTree& made) {
    for (const auto& of_ranks : made.shares)
      for (const RankShares& shares : of_ranks) {
        std::vector<char> seen(static_cast<std::size_t>(made.tree.n_sources));
        for (const IndexRange& run : shares.source_runs)
          for (int i = run.first; i < run.first + run.count; ++i) {
            ASSERT_EQ(seen[static_cast<std::size_t>(i)], 0) << "twice";
            seen[static_cast<std::size_t>(i)] = 1;
          }
        if (!made.tree.same_nodes) continue;
        const NearMatches near = make_near_matches(made.tree, &shares);
        for (const int tile : near.met) {
          const IndexRange run = near.tiles[static_cast<std::size_t>(tile)];
          for (int i = run.first; i < run.first + run.count; ++i) ASSERT_EQ(seen[static_cast<std::size_t>(i)], 1);
        }
      }
  });
}

// The ranks' matches, each in the order of all, give a tile with targets of a rank all the matches that it has in all.
TEST(RankShares, TilesOfARankMeetAllTheyWould) {
  for_trees([](const RankTree& made) {
    if (!made.tree.same_nodes) return;
    const NearMatches all = make_near_matches(made.tree);
    for (const auto& of_ranks : made.shares)
      for (const RankShares& shares : of_ranks) {
        const auto matches_of = [&](const NearMatches& near, const int tile) {
          std::vector<std::pair<int, int>> found;
          for (const Match& match : near.matches)
            if (match.one == tile || match.other == tile) found.emplace_back(match.one, match.other);
          return found;
        };
        const NearMatches own = make_near_matches(made.tree, &shares);
        for (int tile = 0; tile < static_cast<int>(all.tiles.size()); ++tile)
          if (shares.has_target(all.tiles[static_cast<std::size_t>(tile)].first)) {
            ASSERT_EQ(matches_of(own, tile), matches_of(all, tile));
          }
      }
  });
}

TEST(RankShares, WorkOfManyLeavesIsEven) {
  const RankTree made(Cloud::cube, 4000, true);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_LT(made.shares[i].front().balance, 1.15) << made.shares[i].size() << " ranks";
}

}  // namespace
}  // namespace skein
