#include "fmm/rank_shares.hpp"

#include <skein/fmm/fmm_cost.hpp>

#include "fmm/fmm_operator_set.hpp"

#include <algorithm>
#include <string>

namespace skein {
namespace {

constexpr int several = -1, nobody = -2;

std::vector<WorkPiece> list_target_work(const HostOctree& tree, const FmmPlan& plan, const bool is_symmetric) {
  std::vector<WorkPiece> pieces;
  const auto note = [&](const Box& box, const int b, const double near_pairs) {
    FmmWork work;
    work.n_sources = box.is_leaf() ? box.sources.count : 0;
    work.n_targets = box.is_leaf() ? box.targets.count : 0;
    work.near_pairs = near_pairs;
    work.far_pairs = static_cast<double>(tree.v_list.of(b).size());
    work.n_boxes = 1.0;
    pieces.push_back(
        {box.targets.first, estimate_nanoseconds(work, plan, is_symmetric, KernelPath::host), box.is_leaf()});
  };
  for (int b = 0; b < tree.n_boxes(); ++b)
    if (!tree.box(b).is_leaf() && tree.box(b).targets.count > 0) note(tree.box(b), b, 0.0);
  for (int leaf = 0; leaf < tree.n_target_leaves; ++leaf) {
    const int b = tree.target_leaves(leaf);
    double n_sources = 0.0;
    for (const IndexRange& run : tree.near_runs(leaf)) n_sources += run.count;
    note(tree.box(b), b, n_sources * tree.box(b).targets.count);
  }
  return pieces;
}

std::vector<int> cut_sources(const HostOctree& tree, const int n_ranks) {
  std::vector<WorkPiece> pieces;
  for (int b = 0; b < tree.n_boxes(); ++b) {
    const Box& box = tree.box(b);
    if (box.is_leaf() && box.sources.count > 0)
      pieces.push_back({box.sources.first, static_cast<double>(box.sources.count), true});
  }
  double ignored = 1.0;
  return cut_work(pieces, tree.n_sources, n_ranks, ignored);
}

/// Of the sources of each box.
std::vector<int> find_owners(const HostOctree& tree, const std::vector<int>& first_source) {
  std::vector<int> owners;
  for (int b = 0; b < tree.n_boxes(); ++b) {
    const Box& box = tree.box(b);
    const int last = box.sources.first + box.sources.count - 1;
    const int owner = box.sources.count == 0 ? nobody : rank_of(first_source, box.sources.first);
    owners.push_back(owner == nobody || owner == rank_of(first_source, last) ? owner : several);
  }
  return owners;
}

/// Who needs whose coefficients: entry [rank][box].
class Needs {
 public:
  Needs(const HostOctree& tree, const RankShares& shares, const std::vector<int>& owners)
      : tree_(tree), shares_(shares), owners_(owners) {
    needed_.assign(static_cast<std::size_t>(shares.n_ranks),
                   std::vector<char>(static_cast<std::size_t>(tree.n_boxes())));
  }

  /// Everything that the targets of a box need a source's box for.
  void note(const Box& at, const int source) {
    const int owner = owners_[static_cast<std::size_t>(source)];
    if (owner < 0) return;
    const int first = rank_of(shares_.first_target, at.targets.first);
    const int last = rank_of(shares_.first_target, at.targets.first + at.targets.count - 1);
    for (int rank = first; rank <= last; ++rank) note(rank, owner, source);
  }
  void note(const int rank, const int owner, const int source) {
    if (rank != owner && (rank == shares_.rank || owner == shares_.rank))
      needed_[static_cast<std::size_t>(rank)][static_cast<std::size_t>(source)] = 1;
  }

  void list(RankShares& shares) const {
    shares.sent.resize(static_cast<std::size_t>(shares.n_ranks));
    shares.received.resize(static_cast<std::size_t>(shares.n_ranks));
    for (int b = 0; b < tree_.n_boxes(); ++b) {
      const int owner = owners_[static_cast<std::size_t>(b)];
      if (owner == shares.rank) {
        for (std::size_t rank = 0; rank < needed_.size(); ++rank)
          if (needed_[rank][static_cast<std::size_t>(b)] != 0) shares.sent[rank].push_back(b);
      } else if (owner >= 0 && needed_[static_cast<std::size_t>(shares.rank)][static_cast<std::size_t>(b)] != 0) {
        shares.received[static_cast<std::size_t>(owner)].push_back(b);
      }
    }
  }

 private:
  const HostOctree& tree_;
  const RankShares& shares_;
  const std::vector<int>& owners_;
  std::vector<std::vector<char>> needed_;
};

/// Sources of this rank, and all that its targets meet one by one.
std::vector<IndexRange> find_source_runs(const HostOctree& tree, const RankShares& shares) {
  constexpr int piece = 4096;
  std::vector<IndexRange> runs = {{0, math::smaller(1, tree.n_sources)}, shares.own_sources()};
  for (int leaf = 0; leaf < tree.n_target_leaves; ++leaf)
    if (shares.has_target(tree.target_leaf(leaf).targets.first)) {
      const auto near = tree.near_runs(leaf);
      runs.insert(runs.end(), near.begin(), near.end());
    }
  for (const IndexRange& boxes : shares.target_boxes)
    for (int b = boxes.first; b < boxes.first + boxes.count; ++b)
      for (const int coarse : tree.x_list.of(b)) runs.push_back(tree.box(coarse).sources);
  std::sort(runs.begin(), runs.end(), [](const IndexRange a, const IndexRange b) { return a.first < b.first; });
  std::vector<IndexRange> pieces;
  int next = 0;
  for (const IndexRange& run : runs) {
    const int last = run.first + run.count;
    for (next = math::larger(next, run.first); next < last; next += pieces.back().count)
      pieces.push_back({next, math::smaller(piece, last - next)});
  }
  return pieces;
}

}  // namespace

int rank_of(const std::vector<int>& first, const int place) {
  return static_cast<int>(std::upper_bound(first.begin(), first.end() - 1, place) - first.begin()) - 1;
}

void widen(IndexRange& boxes, const int b) {
  if (boxes.count == 0) boxes.first = b;
  boxes.count = b + 1 - boxes.first;
}

void RankShares::count_boxes() {
  n_boxes = static_cast<double>(boxes_of_all.size());
  for (const IndexRange& boxes : source_boxes) n_boxes += boxes.count;
  for (const std::vector<int>& boxes : received) n_boxes += static_cast<double>(boxes.size());
  for (const IndexRange& boxes : target_boxes) n_boxes += boxes.count;
}

std::vector<int> cut_work(std::vector<WorkPiece>& pieces, const int n_places, const int n_ranks, double& balance) {
  std::sort(pieces.begin(), pieces.end(), [](const WorkPiece& a, const WorkPiece& b) { return a.first < b.first; });
  double total = 0.0;
  for (const WorkPiece& piece : pieces) total += piece.work;
  std::vector<int> edges = {0};
  std::vector<double> work(static_cast<std::size_t>(n_ranks));
  double before = 0.0;
  for (const WorkPiece& piece : pieces) {
    // A leaf goes to the next rank where its middle lies beyond the edge.
    while (piece.is_leaf && static_cast<int>(edges.size()) < n_ranks && piece.first > edges.back() &&
           before + 0.5 * piece.work > total * static_cast<double>(edges.size()) / n_ranks)
      edges.push_back(piece.first);
    work[edges.size() - 1] += piece.work;
    before += piece.work;
  }
  edges.resize(static_cast<std::size_t>(n_ranks) + 1, n_places);
  balance = total > 0.0 ? *std::max_element(work.begin(), work.end()) * n_ranks / total : 1.0;
  return edges;
}

RankShares share_tree(const HostOctree& tree, const FmmPlan& plan, const bool is_symmetric, const int rank,
                      const int n_ranks) {
  RankShares shares;
  shares.rank = rank;
  shares.n_ranks = n_ranks;
  std::vector<WorkPiece> pieces = list_target_work(tree, plan, is_symmetric);
  shares.first_target = cut_work(pieces, tree.n_targets, n_ranks, shares.balance);
  shares.first_source = tree.same_nodes ? shares.first_target : cut_sources(tree, n_ranks);
  const std::vector<int> owners = find_owners(tree, shares.first_source);
  shares.source_boxes.resize(static_cast<std::size_t>(tree.n_levels()));
  shares.target_boxes.resize(static_cast<std::size_t>(tree.n_levels()));
  Needs needs(tree, shares, owners);
  const IndexRange own = shares.own_targets();
  for (int b = tree.n_boxes() - 1; b >= 0; --b) {
    const Box& box = tree.box(b);
    if (owners[static_cast<std::size_t>(b)] != several || box.level < first_far_level) continue;
    shares.boxes_of_all.push_back(b);
    for (int child = box.first_child; child < box.first_child + box.n_children; ++child)
      for (int other = 0; other < n_ranks && owners[static_cast<std::size_t>(child)] >= 0; ++other)
        needs.note(other, owners[static_cast<std::size_t>(child)], child);
  }
  for (int b = 0; b < tree.n_boxes(); ++b) {
    const Box& box = tree.box(b);
    const auto level = static_cast<std::size_t>(box.level);
    if (owners[static_cast<std::size_t>(b)] == rank) widen(shares.source_boxes[level], b);
    if (box.targets.count > 0 && box.targets.first < own.first + own.count &&
        box.targets.first + box.targets.count > own.first)
      widen(shares.target_boxes[level], b);
    for (const FarPair& pair : tree.v_list.of(b)) needs.note(box, pair.source);
  }
  for (int leaf = 0; leaf < tree.n_target_leaves; ++leaf) {
    for (const int fine : tree.w_list.of(leaf)) needs.note(tree.target_leaf(leaf), fine);
  }
  needs.list(shares);
  shares.source_runs = find_source_runs(tree, shares);
  shares.count_boxes();
  return shares;
}

void drop_far_pairs_but(const std::vector<IndexRange>& boxes_of_level, HostOctree& tree) {
  const auto is_kept = [&](const int b) {
    const IndexRange boxes = boxes_of_level[static_cast<std::size_t>(tree.box(b).level)];
    return b >= boxes.first && b < boxes.first + boxes.count;
  };
  Lists<FarPair, HostSpace> kept;
  require_extent(kept.first, static_cast<std::size_t>(tree.n_boxes()) + 1, "skein::octree::v_first");
  for (int b = 0; b < tree.n_boxes(); ++b) {
    kept.first(b) = kept.n_entries;
    kept.n_entries += is_kept(b) ? static_cast<int>(tree.v_list.of(b).size()) : 0;
  }
  kept.first(tree.n_boxes()) = kept.n_entries;
  kept.entries = Kokkos::View<FarPair*, HostSpace>(std::string("skein::octree::list"), kept.n_entries);
  for (int b = 0; b < tree.n_boxes(); ++b)
    if (is_kept(b)) {
      const auto pairs = tree.v_list.of(b);
      std::copy(pairs.begin(), pairs.end(), kept.entries.data() + kept.first(b));
    }
  tree.v_list = kept;
}

}  // namespace skein
