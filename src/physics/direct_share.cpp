#include "direct_share.hpp"

#include <skein/arrays/combination.hpp>
#include <skein/core/error.hpp>

#include "direct_sums.hpp"
#include "kernels/stokeslet_block.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace skein {
namespace {

std::vector<int> edges_of(const RankParts& owners) {
  std::vector<int> edges(owners.first.begin(), owners.first.end());
  edges.push_back(static_cast<int>(owners.total()));
  return edges;
}

/// Edges of as many even parts of n things.
std::vector<int> cut_evenly(const int n, const int n_parts) {
  return edges_of(RankParts::evenly(static_cast<std::size_t>(n), n_parts));
}

int count_of(const std::vector<int>& first, const int rank) {
  const auto r = static_cast<std::size_t>(rank);
  return first[r + 1] - first[r];
}

RankParts three_each(const std::vector<int>& first_node) {
  std::vector<std::size_t> count;
  for (std::size_t r = 0; r + 1 < first_node.size(); ++r)
    count.push_back(3 * static_cast<std::size_t>(first_node[r + 1] - first_node[r]));
  return RankParts::behind_each_other(std::move(count));
}

/// velocity += numbers, which are x, y and z of the nodes between two edges each, behind each other.
void use_numbers(const double* number, const std::vector<int>& first_node, const Vectors& velocity) {
  if (velocity.extent(0) == 0) return;
  const HostVectors sum("skein::DirectShare::sum", velocity.extent(0));
  for (std::size_t r = 0; r + 1 < first_node.size(); ++r) {
    const int n = first_node[r + 1] - first_node[r];
    for (int c = 0; c < 3; ++c, number += n)
      if (n > 0) std::copy_n(number, n, &sum(first_node[r], c));
  }
  const Vectors on_device = Kokkos::create_mirror_view_and_copy(ExecSpace::memory_space(), sum);
  combine<ExecSpace>(ExecSpace(), velocity, {1.0, velocity}, {1.0, on_device});
}

/// Velocities of consecutive targets, from the ranks that have summed them to those that own them.
class TargetsToOwners {
 public:
  TargetsToOwners(const std::vector<int>& first, const std::vector<int>& owned, const int rank) {
    const auto r = static_cast<std::size_t>(rank);
    std::vector<std::size_t> n_sent, n_received;
    for (std::size_t other = 0; other + 1 < first.size(); ++other) {
      const int from = math::larger(first[r], owned[other]), to = math::smaller(first[r + 1], owned[other + 1]);
      sent_first_.push_back(from - first[r]);
      sent_count_.push_back(math::larger(0, to - from));
      n_sent.push_back(3 * static_cast<std::size_t>(sent_count_.back()));
      const int edge = math::smaller(math::larger(first[other + 1], owned[r]), owned[r + 1]) - owned[r];
      received_edges_.push_back(math::larger(received_edges_.back(), edge));
      n_received.push_back(3 * static_cast<std::size_t>(received_edges_.back() - received_edges_[other]));
    }
    sent_ = RankParts::behind_each_other(std::move(n_sent));
    received_ = RankParts::behind_each_other(std::move(n_received));
  }

  /// @param own  summed here  @param velocity  of the targets that are owned here: they are added to it
  void run(Communicator& ranks, const HostVectors& own, const Vectors& velocity) const {
    std::vector<double> send, received(received_.total());
    for (std::size_t other = 0; other < sent_first_.size(); ++other)
      for (int c = 0; c < 3 && sent_count_[other] > 0; ++c)
        send.insert(send.end(), &own(sent_first_[other], c), &own(sent_first_[other], c) + sent_count_[other]);
    ranks.exchange(send.data(), sent_, received.data(), received_);
    use_numbers(received.data(), received_edges_, velocity);
  }

 private:
  std::vector<int> sent_first_, sent_count_, received_edges_ = {0};
  RankParts sent_, received_;
};

/// The slices of some nodes that blocks of rounds contribute, added up along the tree.
class SliceSum {
 public:
  SliceSum(const PairRounds& rounds, const std::size_t slice_size) : rounds_(rounds), slice_size_(slice_size) {}
  void note(const RoundBlock& block, double* slice) { slices_.emplace_back(block, slice); }
  double* add_up(const RoundBlock& block) const {
    for (const auto& [there, slice] : slices_)
      if (there == block) return slice;
    SKEIN_REQUIRE(block.level > 0, "a round that no rank has played");
    double* const sum = add_up({block.level - 1, 2 * block.index});
    if (!rounds_.has_second_half(block)) return sum;
    const double* const other = add_up({block.level - 1, 2 * block.index + 1});
    for (std::size_t i = 0; i < slice_size_; ++i) sum[i] += other[i];
    return sum;
  }

 private:
  const PairRounds& rounds_;
  std::size_t slice_size_;
  std::vector<std::pair<RoundBlock, double*>> slices_;
};

}  // namespace

void DirectShare::add_velocity(Communicator& ranks, const Sources& sources, const ConstVectors& target,
                               const Vectors& velocity, const double viscosity, const Precision precision,
                               const bool by_teams, const RankParts* owners) {
  if (!by_teams && weighs_pairs_once(sources, target))
    add_in_rounds(ExecSpace(), ranks, sources, velocity, viscosity, precision, owners);
  else
    add_for_targets(ranks, sources, target, velocity, viscosity, precision, by_teams, owners);
}

void DirectShare::add_for_targets(Communicator& ranks, const Sources& sources, const ConstVectors& target,
                                  const Vectors& velocity, const double viscosity, const Precision precision,
                                  const bool by_teams, const RankParts* owners) {
  // Whole blocks, as one rank would have them.
  const int n_targets = target.extent_int(0);
  std::vector<int> first = cut_evenly(math::ceil_div(n_targets, block_targets), ranks.size());
  partition_ = fmt::format("{} blocks of targets", math::ceil_div(n_targets, block_targets));
  for (int& edge : first) edge = math::smaller(edge * block_targets, n_targets);
  const int own_first = first[static_cast<std::size_t>(ranks.rank())], n_own = count_of(first, ranks.rank());
  const Vectors own("skein::DirectShare::own", static_cast<std::size_t>(n_own));
  ranks.begin_work(RankWork::direct_sum);
  if (n_own > 0) {
    const auto own_targets = Kokkos::subview(target, std::make_pair(own_first, own_first + n_own), Kokkos::ALL());
    add_general_velocity(sources, own_targets, n_targets, own, viscosity, precision, by_teams, partial_);
  }
  const auto on_host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), own);
  if (owners != nullptr) {
    TargetsToOwners(first, edges_of(*owners), ranks.rank()).run(ranks, on_host, velocity);
    return ranks.end_work();
  }
  collect(ranks, on_host.data(), first, velocity);
}

void DirectShare::collect(Communicator& ranks, const double* own, const std::vector<int>& first,
                          const Vectors& velocity) {
  const RankParts parts = three_each(first);
  if (ranks.rank() == 0) gathered_.resize(parts.total());
  ranks.gather(own, parts, gathered_.data());
  ranks.end_work();
  if (ranks.rank() == 0) use_numbers(gathered_.data(), first, velocity);
}

template <class Space>
void DirectShare::add_in_rounds(const Space& space, Communicator& ranks, const Sources& sources,
                                const Vectors& velocity, const double viscosity, const Precision precision,
                                const RankParts* owners) {
  if constexpr (on_host<Space>) {
    const int n_nodes = sources.position.extent_int(0), n_ranks = ranks.size();
    const PairRounds rounds(n_nodes);
    const std::vector<IndexRange> shares = rounds.share(n_ranks);
    const std::vector<int> first = owners == nullptr ? cut_evenly(n_nodes, n_ranks) : edges_of(*owners);
    const std::vector<RoundBlock> own_blocks = rounds.list_blocks(shares[static_cast<std::size_t>(ranks.rank())]);
    partition_ = fmt::format("{} rounds of pairs, each pair of nodes in one of them", rounds.n_tiles);
    ranks.begin_work(RankWork::direct_sum);
    if (blocks_.size() < own_blocks.size()) blocks_.resize(own_blocks.size());
    for (std::size_t b = 0; b < own_blocks.size(); ++b) {
      if (blocks_[b].extent_int(0) != n_nodes) blocks_[b] = HostVectors("skein::DirectShare::block", n_nodes);
      compute_round_velocity(space, sources.position, sources.force, sources.blob, rounds, own_blocks[b], blocks_[b],
                             viscosity, precision, scratch_);
    }

    // To each rank the slices of its nodes, block by block.
    std::vector<std::size_t> n_sent, n_received;
    std::vector<std::vector<RoundBlock>> blocks_of;
    const int n_own = count_of(first, ranks.rank());
    send_.clear();
    for (int rank = 0; rank < n_ranks; ++rank) {
      const int n = count_of(first, rank), from = first[static_cast<std::size_t>(rank)];
      for (std::size_t b = 0; b < own_blocks.size(); ++b)
        for (int c = 0; c < 3; ++c) send_.insert(send_.end(), &blocks_[b](from, c), &blocks_[b](from, c) + n);
      blocks_of.push_back(rounds.list_blocks(shares[static_cast<std::size_t>(rank)]));
      n_sent.push_back(3 * own_blocks.size() * static_cast<std::size_t>(n));
      n_received.push_back(3 * blocks_of.back().size() * static_cast<std::size_t>(n_own));
    }
    const RankParts received = RankParts::behind_each_other(n_received);
    received_.resize(received.total());
    ranks.exchange(send_.data(), RankParts::behind_each_other(n_sent), received_.data(), received);
    const std::size_t slice_size = 3 * static_cast<std::size_t>(n_own);
    SliceSum sum(rounds, slice_size);
    double* slice = received_.data();
    for (const std::vector<RoundBlock>& blocks : blocks_of)
      for (const RoundBlock& block : blocks) {
        sum.note(block, slice);
        slice += slice_size;
      }
    const double* const own = sum.add_up({rounds.top_level(), 0});
    if (owners != nullptr) {
      use_numbers(own, {0, n_own}, velocity);
      return ranks.end_work();
    }
    collect(ranks, own, first, velocity);
  }
}

}  // namespace skein
