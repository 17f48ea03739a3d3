#include "fmm/essential_boxes.hpp"

#include <algorithm>

namespace skein {
namespace {

/// True where a box touches another one's ancestor of its own level, or the other one where that is the coarser.
bool touches_at_its_level(const Box& box, Box other) {
  if (other.level > box.level) {
    for (int& cell : other.cell) cell >>= other.level - box.level;
    other.level = box.level;
  }
  return touch(box, other);
}

/// What one rank needs of another's boxes.
class Search {
 public:
  Search(const TopTree& top, const OwnBoxes& own, const int min_sources)
      : top_(top), own_(own), min_sources_(min_sources) {}

  /// @param from, to  ranks
  std::vector<BoxRecord> run(const int from, const int to) {
    found_.clear();
    std::vector<Box> theirs;
    for (const int leaf : top_.leaves)
      if (top_.owner[static_cast<std::size_t>(leaf)] == to)
        theirs.push_back(top_.boxes[static_cast<std::size_t>(leaf)]);
    int i = 0;
    for (const int leaf : top_.leaves) {
      if (top_.owner[static_cast<std::size_t>(leaf)] != from) continue;
      below_ = &own_.below[static_cast<std::size_t>(i)];
      first_tile_ = &own_.first_tile[static_cast<std::size_t>(i++)];
      look_at_leaf_of_top(top_.boxes[static_cast<std::size_t>(leaf)], theirs);
    }
    return found_;
  }

 private:
  void look_at_leaf_of_top(const Box& leaf, const std::vector<Box>& theirs) {
    const std::vector<Box> near = those_near(leaf, theirs);
    // The box itself is known; what its tiles are called is not.
    if (below_->front().is_leaf() && (!near.empty() || is_never_expanded(leaf, theirs))) tell(0);
    if (!near.empty()) descend(0, near);
  }
  /// A box of few nodes may be met one by one by what its parent touches, and so may those inside it.
  bool is_never_expanded(const Box& box, const std::vector<Box>& theirs) const {
    for (const Box* b = &box; b->parent >= 0; b = &top_.boxes[static_cast<std::size_t>(b->parent)])
      if (b->sources.count < min_sources_ &&
          !those_near(top_.boxes[static_cast<std::size_t>(b->parent)], theirs).empty())
        return true;
    return false;
  }
  void descend(const int b, const std::vector<Box>& near) {
    const Box& box = (*below_)[static_cast<std::size_t>(b)];
    for (int child = box.first_child; child < box.first_child + box.n_children; ++child) {
      tell(child);
      const Box& below = (*below_)[static_cast<std::size_t>(child)];
      if (below.is_leaf()) continue;
      const std::vector<Box> nearer = those_near(below, near);
      if (!nearer.empty()) descend(child, nearer);
    }
  }
  void tell(const int b) {
    const Box& box = (*below_)[static_cast<std::size_t>(b)];
    BoxRecord record;
    record.level = box.level;
    std::copy_n(box.cell, 3, record.cell);
    record.sources = box.sources;
    record.first_tile = (*first_tile_)[static_cast<std::size_t>(b)];
    record.is_split = box.is_leaf() ? 0 : 1;
    found_.push_back(record);
  }
  static std::vector<Box> those_near(const Box& box, const std::vector<Box>& boxes) {
    std::vector<Box> near;
    std::copy_if(boxes.begin(), boxes.end(), std::back_inserter(near),
                 [&](const Box& other) { return touches_at_its_level(box, other); });
    return near;
  }
  const TopTree& top_;
  const OwnBoxes& own_;
  int min_sources_;
  const std::vector<Box>* below_ = nullptr;
  const std::vector<int>* first_tile_ = nullptr;
  std::vector<BoxRecord> found_;
};

}  // namespace

std::vector<std::vector<BoxRecord>> find_essential_boxes(const TopTree& top, const OwnBoxes& own, const int rank,
                                                         const int n_ranks, const int min_sources) {
  std::vector<std::vector<BoxRecord>> boxes(static_cast<std::size_t>(n_ranks));
  Search search(top, own, min_sources);
  for (int other = 0; other < n_ranks; ++other)
    if (other != rank) boxes[static_cast<std::size_t>(other)] = search.run(rank, other);
  return boxes;
}

}  // namespace skein
