#include "fmm/essential_tree.hpp"

#include <algorithm>
#include <utility>

// A rank's part of a tree is put together from the top of the whole tree, own boxes and those that others have told of;
// then, when its lists are made, the nodes that they ask for find their places.

namespace skein {
namespace {

/// A box on its way into the tree.
struct Entry {
  std::uint64_t cell = 0;  ///< key at the box's own level
  Box box;                 ///< sources in the order of all nodes
  int owner = TopTree::several, first_tile = 0;
};

Entry make_entry(const Box& box, const int owner, const int first_tile) {
  return {first_key(box, box.level), box, owner, first_tile};
}

/// What n_children is before children are counted.
constexpr int no_children = 0, unknown_children = -1;

}  // namespace

void EssentialTree::assemble(const std::vector<std::vector<BoxRecord>>& others, const int n_levels, HostOctree& tree) {
  const TopTree& top = deal_.top();
  std::vector<std::vector<Entry>> levels(static_cast<std::size_t>(n_levels));
  const auto add = [&](const Entry& entry) { levels[static_cast<std::size_t>(entry.box.level)].push_back(entry); };
  for (std::size_t b = 0; b < top.boxes.size(); ++b) {
    Box box = top.boxes[b];
    const bool is_split = box.level < tree.cube.max_depth && box.sources.count > tree.cube.split_above(box.level);
    box.n_children = is_split ? unknown_children : no_children;
    add(make_entry(box, top.owner[b], 0));
  }
  for (std::size_t i = 0; i < own_boxes_.below.size(); ++i)
    for (std::size_t b = 0; b < own_boxes_.below[i].size(); ++b) {
      Box box = own_boxes_.below[i][b];
      box.n_children = no_children;  // which follow
      add(make_entry(box, rank_, own_boxes_.first_tile[i][b]));
    }
  for (std::size_t r = 0; r < others.size(); ++r)
    for (const BoxRecord& record : others[r]) {
      Box box;
      box.level = record.level;
      std::copy_n(record.cell, 3, box.cell);
      box.sources = record.sources;
      box.n_children = record.is_split != 0 ? unknown_children : no_children;
      add(make_entry(box, static_cast<int>(r), record.first_tile));
    }

  tree.level_first = {0};
  owner_.clear();
  first_tile_.clear();
  std::vector<Box> boxes;
  const IndexRange own = deal_.own_places();
  std::vector<std::uint64_t> above, here;
  for (std::vector<Entry>& level : levels) {
    // Leaves of the top come twice: from there, and with the numbers of their tiles behind it.
    std::stable_sort(level.begin(), level.end(), [](const Entry& a, const Entry& b) { return a.cell < b.cell; });
    std::size_t parent = 0;
    here.clear();
    const auto first_above = static_cast<std::size_t>(boxes.size()) - above.size();
    for (const Entry& entry : level) {
      if (!here.empty() && here.back() == entry.cell) {
        first_tile_.back() = entry.first_tile;
        continue;
      }
      Box box = entry.box;
      box.octant = static_cast<int>(entry.cell & 7);
      box.parent = -1;
      box.first_child = 0;
      box.targets = common(box.sources, own);
      if (box.level > 0) {
        while (above[parent] < entry.cell >> 3) ++parent;
        box.parent = static_cast<int>(first_above + parent);
        Box& its_parent = boxes[first_above + parent];
        if (its_parent.n_children <= 0) {
          its_parent.first_child = static_cast<int>(boxes.size());
          its_parent.n_children = 0;
        }
        ++its_parent.n_children;
      }
      boxes.push_back(box);
      here.push_back(entry.cell);
      owner_.push_back(entry.owner);
      first_tile_.push_back(entry.first_tile);
    }
    std::swap(above, here);
    tree.level_first.push_back(static_cast<int>(boxes.size()));
  }
  require_extent(tree.boxes, boxes.size(), "skein::octree::boxes");
  std::copy(boxes.begin(), boxes.end(), tree.boxes.data());
  tree.same_nodes = true;
}

/// Nodes of other ranks that the lists ask for; then places in the order of all nodes become places of this tree.
void EssentialTree::ask_for_nodes(Communicator& ranks, HostOctree& tree) {
  std::vector<IndexRange> runs = {deal_.own_places()};
  for (int leaf = 0; leaf < tree.n_target_leaves; ++leaf) {
    const auto near = tree.near_runs(leaf);
    runs.insert(runs.end(), near.begin(), near.end());
  }
  for (int k = 0; k < tree.x_list.n_entries; ++k) runs.push_back(tree.box(tree.x_list.entries(k)).sources);
  places_ = NodePlaces(std::move(runs));

  const std::vector<int>& first_node = deal_.top().first_node;
  std::vector<std::vector<IndexRange>> wanted;
  for (std::size_t r = 0; r + 1 < first_node.size(); ++r) {
    wanted.emplace_back();
    if (r != static_cast<std::size_t>(rank_))
      wanted.back() = places_.list_between({first_node[r], first_node[r + 1] - first_node[r]});
  }
  std::vector<int> rows;
  std::vector<std::size_t> n_to;
  for (const auto& of_rank : exchange_lists(ranks, wanted)) {
    const std::size_t n_before = rows.size();
    for (const IndexRange& run : of_rank)
      for (int place = run.first; place < run.first + run.count; ++place)
        rows.push_back(place - deal_.own_places().first);
    n_to.push_back(rows.size() - n_before);
  }
  to_neighbours_.agree(ranks, std::move(rows), std::move(n_to));
  place_of_copy_.clear();
  for (const auto& from_rank : wanted)
    for (const IndexRange& run : from_rank) {
      const IndexRange here = places_.find(run);
      for (int i = 0; i < here.count; ++i) place_of_copy_.push_back(here.first + i);
    }

  own_places_ = places_.find(deal_.own_places());
  for (int b = 0; b < tree.n_boxes(); ++b) {
    Box& box = tree.boxes(b);
    box.sources = places_.find(box.sources);
    box.targets = box.targets.count > 0 ? places_.find(box.targets) : IndexRange{};
  }
  for (int leaf = 0; leaf < tree.n_target_leaves; ++leaf)
    for (int k = tree.u_list.first(leaf); k < tree.near_end(leaf); ++k)
      tree.u_list.entries(k) = places_.find(tree.u_list.entries(k));
  const int n = places_.n_places();
  tree.n_sources = tree.n_targets = n;
  tree.sources.require(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) tree.sources.order(i) = i;
}

}  // namespace skein
