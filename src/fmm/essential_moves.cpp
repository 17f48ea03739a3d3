#include <skein/fmm/fmm_cost.hpp>

#include "fmm/essential_tree.hpp"
#include "fmm/fmm_operator_set.hpp"
#include "fmm/tree_fit.hpp"

#include <algorithm>

// What a rank does with the nodes and boxes of its part of a tree.

namespace skein {
namespace {

int find_box(const HostOctree& tree, const CellName& name) {
  Box wanted;
  wanted.level = name.level;
  std::copy_n(name.cell, 3, wanted.cell);
  const IndexRange level = tree.level(name.level);
  const Box* const first = tree.boxes.data() + level.first;
  const Box* const last = first + level.count;
  const auto key = [&](const Box& box) { return first_key(box, name.level); };
  const Box* const there =
      std::lower_bound(first, last, wanted, [&](const Box& a, const Box& b) { return key(a) < key(b); });
  SKEIN_REQUIRE(there != last && key(*there) == key(wanted), "another rank asks for a box that is not here");
  return static_cast<int>(there - tree.boxes.data());
}

/// Boxes whose coefficients this rank's targets need of other ranks. Entry r is rank r's.
std::vector<std::vector<int>> list_needed(const HostOctree& tree, const RankShares& shares,
                                          const std::vector<int>& owner) {
  std::vector<std::vector<int>> needed(static_cast<std::size_t>(shares.n_ranks));
  const auto note = [&](const int b) {
    const int of = owner[static_cast<std::size_t>(b)];
    if (of != TopTree::several && of != shares.rank) needed[static_cast<std::size_t>(of)].push_back(b);
  };
  for (const int b : shares.boxes_of_all)
    for (int child = tree.box(b).first_child; child < tree.box(b).first_child + tree.box(b).n_children; ++child)
      note(child);
  for (int k = 0; k < tree.v_list.n_entries; ++k) note(tree.v_list.entries(k).source);
  for (int k = 0; k < tree.w_list.n_entries; ++k) note(tree.w_list.entries(k));
  for (std::vector<int>& boxes : needed) {
    std::sort(boxes.begin(), boxes.end());
    boxes.erase(std::unique(boxes.begin(), boxes.end()), boxes.end());
  }
  return needed;
}

}  // namespace

void EssentialTree::move_nodes(Communicator& ranks, const HostOctree& tree, const UnsortedNodes<HostSpace>& own,
                               const double one_blob, const double scale, SortedNodes<HostSpace>& nodes) {
  require_nodes(tree, nodes);
  const bool has_blobs = one_blob == 0.0;
  if (!has_blobs) Kokkos::deep_copy(HostSpace(), nodes.blob, one_blob);
  store(nodes.position, 0, Vec3{});  // nobody's
  store(nodes.force, 0, Vec3{});
  nodes.blob(0) = has_blobs ? 1.0 : one_blob;
  deal_.move(ranks, own.position, 1.0, own_places_.first, nodes.position);
  deal_.move(ranks, own.force, scale, own_places_.first, nodes.force);
  if (has_blobs) deal_.move(ranks, own.blob, own_places_.first, nodes.blob);

  const std::size_t width = has_blobs ? 7 : 6;
  std::vector<double> numbers;
  numbers.reserve(width * to_neighbours_.rows().size());
  for (const int row : to_neighbours_.rows()) {
    const int place = own_places_.first + row;
    for (int c = 0; c < 3; ++c) numbers.push_back(nodes.position(place, c));
    for (int c = 0; c < 3; ++c) numbers.push_back(nodes.force(place, c));
    if (has_blobs) numbers.push_back(nodes.blob(place));
  }
  const std::vector<double> received = to_neighbours_.send(ranks, numbers, width);
  const double* from = received.data();
  for (const int place : place_of_copy_) {
    for (int c = 0; c < 3; ++c) nodes.position(place, c) = from[c];
    for (int c = 0; c < 3; ++c) nodes.force(place, c) = from[3 + c];
    if (has_blobs) nodes.blob(place) = from[6];
    from += width;
  }
}

bool EssentialTree::still_fits(Communicator& ranks, const HostOctree& tree, const SortedNodes<HostSpace>& nodes) const {
  seek_strays<HostSpace>(HostSpace(), own_leaves_, tree.cube, {nodes.position, tree.sources.order}, {}, tree.n_strays);
  const std::vector<double> all = list_from_all(ranks, {tree.still_fits() ? 1.0 : 0.0});
  return std::find(all.begin(), all.end(), 0.0) == all.end();
}

RankShares EssentialTree::make_shares(Communicator& ranks, const HostOctree& tree, const FmmPlan& plan,
                                      const bool is_symmetric) {
  RankShares shares;
  shares.rank = rank_;
  shares.n_ranks = ranks.size();
  shares.balance = deal_.top().balance;
  for (int edge = 0; edge <= shares.n_ranks; ++edge)
    shares.first_target.push_back(own_places_.first + (edge > rank_ ? own_places_.count : 0));
  shares.first_source = shares.first_target;
  shares.source_boxes.resize(static_cast<std::size_t>(tree.n_levels()));
  shares.target_boxes.resize(static_cast<std::size_t>(tree.n_levels()));
  for (int b = 0; b < tree.n_boxes(); ++b) {
    const auto level = static_cast<std::size_t>(tree.box(b).level);
    if (owner_[static_cast<std::size_t>(b)] == rank_) widen(shares.source_boxes[level], b);
    if (tree.box(b).targets.count > 0) widen(shares.target_boxes[level], b);
  }
  for (int b = tree.n_boxes() - 1; b >= 0; --b)
    if (owner_[static_cast<std::size_t>(b)] == TopTree::several && tree.box(b).level >= first_far_level)
      shares.boxes_of_all.push_back(b);
  shares.received = list_needed(tree, shares, owner_);
  std::vector<std::vector<CellName>> names(shares.received.size());
  for (std::size_t r = 0; r < names.size(); ++r)
    for (const int b : shares.received[r]) {
      CellName name;
      name.level = tree.box(b).level;
      std::copy_n(tree.box(b).cell, 3, name.cell);
      names[r].push_back(name);
    }
  for (const auto& of_rank : exchange_lists(ranks, names)) {
    shares.sent.emplace_back();
    for (const CellName& name : of_rank) shares.sent.back().push_back(find_box(tree, name));
  }
  shares.count_boxes();
  deal_.note_work(weigh(tree, plan, is_symmetric));
  return shares;
}

/// What each own place takes, ns: of its leaf, and a part of the boxes around it that are this rank's.
std::vector<float> EssentialTree::weigh(const HostOctree& tree, const FmmPlan& plan, const bool is_symmetric) const {
  std::vector<double> of_node(static_cast<std::size_t>(tree.n_boxes()));  // in a box, from the root down
  const auto estimate = [&](const FmmWork& work) {
    return estimate_nanoseconds(work, plan, is_symmetric, KernelPath::host);
  };
  for (int b = 0; b < tree.n_boxes(); ++b) {
    const Box& box = tree.box(b);
    if (owner_[static_cast<std::size_t>(b)] != rank_) continue;
    FmmWork work;
    work.n_boxes = 1.0;
    work.far_pairs = static_cast<double>(tree.v_list.of(b).size());
    of_node[static_cast<std::size_t>(b)] =
        estimate(work) / box.sources.count + (box.parent >= 0 ? of_node[static_cast<std::size_t>(box.parent)] : 0.0);
  }
  std::vector<float> of_place(static_cast<std::size_t>(own_places_.count));
  for (int leaf = 0; leaf < tree.n_target_leaves; ++leaf) {
    const Box& box = tree.target_leaf(leaf);
    FmmWork work;
    work.n_sources = work.n_targets = 1.0;
    for (const IndexRange& run : tree.near_runs(leaf)) work.near_pairs += run.count;
    const auto each = static_cast<float>(estimate(work) + of_node[static_cast<std::size_t>(tree.target_leaves(leaf))]);
    std::fill_n(of_place.begin() + (box.targets.first - own_places_.first), box.targets.count, each);
  }
  return of_place;
}

double EssentialTree::bytes() const {
  return deal_.bytes() + to_neighbours_.bytes() + 4.0 * static_cast<double>(place_of_copy_.size()) +
         8.0 * static_cast<double>(owner_.size()) + static_cast<double>(own_leaves_.extent(0) * sizeof(Box));
}

}  // namespace skein
