#include "fmm/top_tree.hpp"

#include "fmm/rank_shares.hpp"

#include <algorithm>

namespace skein {
namespace {

/// Of the top tree, for each rank: so many that none has much more work than the others.
constexpr int leaves_per_rank = 48;

std::uint64_t cell_key(const Box& box) {
  return morton_key(static_cast<std::uint64_t>(box.cell[0]), static_cast<std::uint64_t>(box.cell[1]),
                    static_cast<std::uint64_t>(box.cell[2]));
}

/// Where the keys of a box's octants begin among some; octant 8 ends them.
struct OctantEdges {
  std::size_t first[9];

  OctantEdges(const std::span<const std::uint64_t> key, const Box& box, const int max_depth) {
    const int shift = 3 * (max_depth - box.level - 1);
    std::size_t from = 0;
    for (std::uint64_t octant = 0; octant <= 8; ++octant) {
      const std::uint64_t least = (8 * cell_key(box) + octant) << shift;
      from = static_cast<std::size_t>(
          std::lower_bound(key.begin() + static_cast<std::ptrdiff_t>(from), key.end(), least) - key.begin());
      first[octant] = from;
    }
  }
};

/// To be added behind all boxes that there are. @param count  of nodes, per octant
void add_children(const int parent, const int (&count)[8], std::vector<Box>& boxes) {
  const auto p = static_cast<std::size_t>(parent);
  boxes[p].first_child = static_cast<int>(boxes.size());
  int first = boxes[p].sources.first;
  for (int octant = 0; octant < 8; first += count[octant++]) {
    if (count[octant] == 0) continue;
    ++boxes[p].n_children;
    const IndexRange nodes{first, count[octant]};
    boxes.push_back(make_child(boxes[p], parent, octant, nodes, nodes));
  }
}

/// Numbers of own nodes in the octants of some boxes, then their work.
std::vector<double> count_octants(const SortedKeys& own, const OctreeCube& cube, const std::vector<Box>& boxes,
                                  const std::vector<int>& wanted) {
  std::vector<double> numbers;
  for (const int b : wanted) {
    const OctantEdges edges(own.key, boxes[static_cast<std::size_t>(b)], cube.max_depth);
    for (int octant = 0; octant < 8; ++octant)
      numbers.push_back(static_cast<double>(edges.first[octant + 1] - edges.first[octant]));
    for (int octant = 0; octant < 8; ++octant)
      numbers.push_back(own.work_before[edges.first[octant + 1]] - own.work_before[edges.first[octant]]);
  }
  return numbers;
}

/// Leaves go to ranks, and then it is known who has all of a box.
void deal(const std::vector<double>& work, const int n_ranks, TopTree& top) {
  std::vector<WorkPiece> pieces;
  for (const int leaf : top.leaves) {
    const auto l = static_cast<std::size_t>(leaf);
    pieces.push_back({top.boxes[l].sources.first, work[l], true});
  }
  top.first_node = cut_work(pieces, top.boxes.front().sources.count, n_ranks, top.balance);
  top.owner.assign(top.boxes.size(), TopTree::several);
  for (const int leaf : top.leaves) {
    const auto l = static_cast<std::size_t>(leaf);
    top.owner[l] = rank_of(top.first_node, top.boxes[l].sources.first);
  }
  for (std::size_t b = top.boxes.size(); b-- > 0;) {
    const Box& box = top.boxes[b];
    if (box.is_leaf()) continue;
    const auto first = top.owner.begin() + box.first_child;
    if (std::all_of(first, first + box.n_children, [&](const int owner) { return owner == *first; }))
      top.owner[b] = *first;
  }
}

}  // namespace

std::uint64_t first_key(const Box& box, const int max_depth) { return cell_key(box) << 3 * (max_depth - box.level); }

TopTree make_top_tree(Communicator& ranks, const OctreeCube& cube, const SortedKeys& own, const int n_nodes) {
  TopTree top;
  Box root;
  root.sources.count = root.targets.count = n_nodes;
  top.boxes = {root};
  std::vector<double> work = {1.0};
  const int most = math::larger(1, n_nodes / (leaves_per_rank * ranks.size()));
  for (std::size_t first = 0; first < top.boxes.size();) {
    const std::size_t end = top.boxes.size();
    std::vector<int> wanted;
    for (std::size_t b = first; b < end; ++b) {
      const int level = top.boxes[b].level;
      if (level < cube.max_depth && top.boxes[b].sources.count > math::larger(most, cube.split_above(level)))
        wanted.push_back(static_cast<int>(b));
    }
    first = end;
    if (wanted.empty()) continue;
    std::vector<double> numbers = count_octants(own, cube, top.boxes, wanted);
    add_up_to_all(ranks, numbers);
    const double* number = numbers.data();
    for (const int b : wanted) {
      int count[8];
      for (int& n : count) n = static_cast<int>(*number++);
      add_children(b, count, top.boxes);
      for (int octant = 0; octant < 8; ++octant, ++number)
        if (count[octant] > 0) work.push_back(*number);
    }
  }
  for (std::size_t b = 0; b < top.boxes.size(); ++b)
    if (top.boxes[b].is_leaf() && top.boxes[b].sources.count > 0) top.leaves.push_back(static_cast<int>(b));
  std::sort(top.leaves.begin(), top.leaves.end(), [&](const int a, const int b) {
    return top.boxes[static_cast<std::size_t>(a)].sources.first < top.boxes[static_cast<std::size_t>(b)].sources.first;
  });
  deal(work, ranks.size(), top);
  return top;
}

std::vector<Box> split_leaf(const OctreeCube& cube, const Box& leaf, const std::span<const std::uint64_t> key,
                            const int first_node) {
  std::vector<Box> boxes = {leaf};
  boxes[0].parent = -1;
  boxes[0].sources = boxes[0].targets = {first_node, static_cast<int>(key.size())};
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    const Box box = boxes[b];
    if (box.level >= cube.max_depth || box.sources.count <= cube.split_above(box.level)) continue;
    const auto own = key.subspan(static_cast<std::size_t>(box.sources.first - first_node),
                                 static_cast<std::size_t>(box.sources.count));
    const OctantEdges edges(own, box, cube.max_depth);
    int count[8];
    for (int octant = 0; octant < 8; ++octant)
      count[octant] = static_cast<int>(edges.first[octant + 1] - edges.first[octant]);
    add_children(static_cast<int>(b), count, boxes);
  }
  return boxes;
}

}  // namespace skein
