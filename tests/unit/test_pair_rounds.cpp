#include "kernels/pair_rounds.hpp"
#include "tests/unit/stokeslet_case.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <utility>
#include <vector>

// A sum that is divided for any number of processes is the same sum.

namespace skein {
namespace {

constexpr int sizes[] = {1, 256, 300, 500, 1440, 2049, 30000};
constexpr int most_processes = 70;

TEST(PairRounds, EveryRoundIsOneProcessesAndWorkIsEven) {
  for (const int n_nodes : sizes)
    for (int n = 1; n <= most_processes; ++n) {
      const PairRounds rounds(n_nodes);
      int next = 0;
      double most = 0.0;
      for (const IndexRange& share : rounds.share(n)) {
        ASSERT_EQ(share.first, next);
        ASSERT_GE(share.count, 0);
        next += share.count;
        most = std::max(most, share.count - (share.first == 0 && share.count > 0 ? 0.5 : 0.0));
      }
      ASSERT_EQ(next, rounds.n_tiles);
      ASSERT_LE(most, (rounds.n_tiles - 0.5) / n + 1.0) << n_nodes << " nodes, " << n << " processes";
    }
}

TEST(PairRounds, BlocksAreTheRoundsOfAShareAndFew) {
  for (const int n_nodes : sizes) {
    const PairRounds rounds(n_nodes);
    for (int n = 1; n <= most_processes; ++n)
      for (const IndexRange& share : rounds.share(n)) {
        int next = share.first;
        const auto blocks = rounds.list_blocks(share);
        for (const RoundBlock& block : blocks) {
          ASSERT_EQ(block.index << block.level, next);
          next = std::min((block.index + 1) << block.level, rounds.n_tiles);
        }
        ASSERT_EQ(next, share.first + share.count);
        ASSERT_LE(blocks.size(), 2u * static_cast<unsigned>(rounds.top_level()) + 1u);
      }
    const auto all = rounds.list_blocks({0, rounds.n_tiles});
    ASSERT_EQ(all.size(), 1u);
    ASSERT_EQ(all.front(), (RoundBlock{rounds.top_level(), 0}));
  }
}

/// The sum of blocks that are there, along the tree.
std::vector<Vec3> add_up(const PairRounds& rounds, const RoundBlock& block,
                         const std::map<std::pair<int, int>, std::vector<Vec3>>& parts) {
  if (const auto part = parts.find({block.level, block.index}); part != parts.end()) return part->second;
  std::vector<Vec3> sum = add_up(rounds, {block.level - 1, 2 * block.index}, parts);
  if (!rounds.has_second_half(block)) return sum;
  const std::vector<Vec3> other = add_up(rounds, {block.level - 1, 2 * block.index + 1}, parts);
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = sum[i] + other[i];
  return sum;
}

TEST(PairRounds, SharesAddUpToTheSameBits) {
  const int n_nodes = 1111;
  const reference::PointForces from = make_equal_sources(reference::Cloud::tube, n_nodes, {}, 7);
  const HostVectors position = make_host_vectors(from.position), force = make_host_vectors(from.force);
  const HostScalars blob("test::blob", from.blob.size());
  Kokkos::deep_copy(blob, from.blob.front());
  const PairRounds rounds(n_nodes);
  std::vector<HostVectors> scratch;
  for (const Precision precision : {Precision::in_double, Precision::in_single}) {
    const auto compute = [&](const RoundBlock& block) {
      const HostVectors velocity("test::velocity", static_cast<std::size_t>(n_nodes));
      Kokkos::deep_copy(velocity, 1e9);  // what was there before is overwritten
      compute_round_velocity(HostSpace(), position, force, blob, rounds, block, velocity, test_viscosity, precision,
                             scratch);
      std::vector<Vec3> list;
      for (int i = 0; i < n_nodes; ++i) list.push_back(load(velocity, i));
      return list;
    };
    const RoundBlock all{rounds.top_level(), 0};
    const std::vector<Vec3> whole = compute(all);
    for (const int n : {2, 3, 4, 5, 7, 40}) {
      std::map<std::pair<int, int>, std::vector<Vec3>> parts;
      for (const IndexRange& share : rounds.share(n))
        for (const RoundBlock& block : rounds.list_blocks(share)) parts[{block.level, block.index}] = compute(block);
      const std::vector<Vec3> sum = add_up(rounds, all, parts);
      EXPECT_EQ(std::memcmp(sum.data(), whole.data(), sum.size() * sizeof(Vec3)), 0) << n << " processes";
    }
  }
}

}  // namespace
}  // namespace skein
