#include "kernels/octree.hpp"

#include <skein/core/error.hpp>

#include "kernels/morton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skein {
namespace {

using Nodes = ConstVectorView<HostSpace>;

constexpr int n_sampled = 4096;

struct Bounds {
  double low[3], high[3];
};

void widen(Bounds& bounds, const Nodes& nodes) {
  const int n = nodes.extent_int(0);
  for (int c = 0; c < 3; ++c) {
    const double* x = n > 0 ? &nodes(0, c) : nullptr;
    double low = bounds.low[c], high = bounds.high[c];
    for (int i = 0; i < n; ++i) {
      low = x[i] < low ? x[i] : low;
      high = x[i] > high ? x[i] : high;
    }
    bounds.low[c] = low;
    bounds.high[c] = high;
  }
}

/// Cell of a coordinate; what lies outside the cube, or is not a number, goes to a cell at its rim.
std::uint64_t cell_of(const double x, const double corner, const double cells_per_length, const double n_cells) {
  const double cell = (x - corner) * cells_per_length;
  if (!(cell > 0.0)) return 0;
  return static_cast<std::uint64_t>(cell < n_cells ? cell : n_cells - 1.0);
}

struct KeyOf {
  double corner[3];
  double cells_per_length, n_cells;
  std::uint64_t operator()(const Nodes& nodes, const int i) const {
    return morton_key(cell_of(nodes(i, 0), corner[0], cells_per_length, n_cells),
                      cell_of(nodes(i, 1), corner[1], cells_per_length, n_cells),
                      cell_of(nodes(i, 2), corner[2], cells_per_length, n_cells));
  }
};

KeyOf make_key_of(const double (&corner)[3], const double side, const int depth) {
  const double n_cells = static_cast<double>(1 << depth);
  return {{corner[0], corner[1], corner[2]}, n_cells / side, n_cells};
}

struct CellChoice {
  double side;
  int nodes_per_cell;
};

/// Side of the cells that would hold the aimed number of nodes each on average, from a sample: the mean number of nodes
/// per occupied cell as a function of the cell's side, interpolated; where the sample is too thin, extrapolated by the
/// dimension that the coarser cells show (1 for a line, 3 for a cloud). Along a line leaf_size nodes are aimed at; in a
/// cloud, where a box has 189 far pairs instead of three, twice as many.
CellChoice choose_cell(const Nodes& nodes, const double (&corner)[3], const double side, const int leaf_size) {
  const int n = nodes.extent_int(0);
  // Enough to see cells of an eighth of what is aimed at: there a thick line has split across its width, too.
  const std::int64_t n_wanted = std::max<std::int64_t>(n_sampled, std::int64_t{12} * n / leaf_size);
  const int stride = math::larger(1, static_cast<int>(n / n_wanted));
  const int n_keys = math::ceil_div(n, stride);
  const KeyOf key_of = make_key_of(corner, side, max_key_depth);
  std::vector<std::uint64_t> keys(static_cast<std::size_t>(n_keys));
  for (int i = 0; i < n_keys; ++i) keys[static_cast<std::size_t>(i)] = key_of(nodes, i * stride);
  std::sort(keys.begin(), keys.end());
  int n_cells[max_key_depth + 1] = {};
  n_cells[0] = 1;
  for (std::size_t i = 1; i < keys.size(); ++i) {
    const std::uint64_t differ = keys[i] ^ keys[i - 1];
    if (differ != 0) ++n_cells[max_key_depth - (63 - __builtin_clzll(differ)) / 3];
  }
  double slope = 1.0;  // log2 of the growth of the number of cells per level
  double cells = 1.0;
  for (int level = 1; level <= max_key_depth; ++level) {
    const double finer = cells + n_cells[level];
    const bool is_thin = n_keys < 1.5 * finer;
    if (!is_thin) slope = std::clamp(std::log2(finer / cells), 0.5, 3.0);
    const double aimed = leaf_size * std::exp2(0.5 * std::max(0.0, slope - 1.0));
    const double needed = static_cast<double>(n) / aimed / cells;  // more cells than there are here, a factor
    if (is_thin || finer / cells >= needed) {
      const double coarse = side / static_cast<double>(1 << (level - 1));
      return {needed <= 1.0 ? coarse : coarse * std::exp2(-std::log2(needed) / slope), static_cast<int>(aimed)};
    }
    cells = finer;
  }
  return {side / static_cast<double>(1 << max_key_depth), leaf_size};
}

/// Sides change in steps of a quarter octave, so that operators that depend on them can be kept while nodes move.
double quantized(const double side) { return std::exp2(0.25 * std::floor(4.0 * std::log2(side))); }

bool touch(const Box& a, const Box& b) {
  const Box& coarse = a.level < b.level ? a : b;
  const Box& fine = a.level < b.level ? b : a;
  const int levels = fine.level - coarse.level;
  for (int c = 0; c < 3; ++c) {
    const int low = coarse.cell[c] << levels, high = (coarse.cell[c] + 1) << levels;
    if (fine.cell[c] + 1 < low || fine.cell[c] > high) return false;
  }
  return true;
}

}  // namespace

Vec3 Octree::center(const Box& box) const {
  const double side = side_ / static_cast<double>(1 << box.level);
  return {corner_[0] + (box.cell[0] + 0.5) * side, corner_[1] + (box.cell[1] + 0.5) * side,
          corner_[2] + (box.cell[2] + 0.5) * side};
}

double Octree::bytes() const {
  const auto of_list = [](const auto& list) {
    return static_cast<double>(list.entries.capacity() * sizeof(list.entries[0]) + list.first.capacity() * sizeof(int));
  };
  const double n_nodes = static_cast<double>(source_order_.size()) +
                         (same_nodes_ ? 0.0 : static_cast<double>(target_order_.size())) +
                         static_cast<double>(spare_order_.size());
  return 12.0 * n_nodes + static_cast<double>(boxes_.capacity() * sizeof(Box)) + of_list(touching_) + of_list(near_) +
         of_list(one_way_) + of_list(partners_) + of_list(fine_) + of_list(coarse_) + of_list(coarse_direct_) +
         of_list(far_);
}

void Octree::choose_cube(const Nodes& source, const Nodes& target, const OctreeRules& rules) {
  Bounds bounds;
  for (int c = 0; c < 3; ++c) {
    bounds.low[c] = std::numeric_limits<double>::max();
    bounds.high[c] = std::numeric_limits<double>::lowest();
  }
  widen(bounds, source);
  if (!same_nodes_) widen(bounds, target);
  double extent = 0.0, reach = 0.0;
  for (int c = 0; c < 3; ++c) {
    if (!(bounds.high[c] >= bounds.low[c])) bounds.low[c] = bounds.high[c] = 0.0;
    extent = std::max(extent, bounds.high[c] - bounds.low[c]);
    reach = std::max({reach, std::abs(bounds.low[c]), std::abs(bounds.high[c])});
  }
  if (!std::isfinite(extent)) extent = 1.0;
  // A cell smaller than the spacing of the numbers themselves is no cell.
  extent = std::max({extent, 1e-10 * reach, 1e-300}) * (1.0 + 1e-6);
  const double smallest = std::max(2.0 * rules.min_half_width, 1e-13 * reach);

  for (int c = 0; c < 3; ++c) corner_[c] = bounds.low[c];
  const Nodes& more = source.extent(0) >= target.extent(0) ? source : target;
  double cell = extent;
  nodes_per_cell_ = rules.leaf_size;
  if (more.extent_int(0) > rules.leaf_size) {
    const CellChoice choice = choose_cell(more, corner_, extent, rules.leaf_size);
    if (rules.has_quantized_cells) {
      cell = std::min(extent, std::max(smallest, quantized(choice.side)));
    } else {
      // A whole number of cells along the longest side: none at the rim is nearly empty.
      const double n_cells = std::min(std::round(extent / choice.side), std::floor(extent / smallest));
      cell = extent / std::max(1.0, n_cells);
    }
    nodes_per_cell_ = choice.nodes_per_cell;
  }

  side_ = std::max(cell, 1e-300);
  aimed_depth_ = 0;
  while (side_ < extent && aimed_depth_ < max_key_depth) {
    side_ *= 2.0;
    ++aimed_depth_;
  }
  max_depth_ = aimed_depth_;
  while (max_depth_ < max_key_depth && side_ / static_cast<double>(2 << max_depth_) >= smallest) ++max_depth_;

  // The finest cells that hold the whole thickness of a thin direction get their middle where its middle is: a straight
  // fiber then lies in one row of cells instead of across the planes of the octree.
  for (int c = 0; c < 3; ++c) {
    const double thickness = (bounds.high[c] - bounds.low[c]) * (1.0 + 1e-6);
    int level = 0;
    while (level < max_depth_ && side_ / static_cast<double>(2 << level) >= thickness) ++level;
    const double side = side_ / static_cast<double>(1 << level);
    const double row = std::floor(0.5 * static_cast<double>(1 << level));
    if (level > 0)
      corner_[c] = 0.5 * (bounds.low[c] + bounds.high[c]) - (row + 0.5) * side;
    else
      corner_[c] = bounds.low[c] - 1e-7 * extent;
  }
}

void Octree::build(const Nodes& source, const Nodes& target, const OctreeRules& rules) {
  SKEIN_REQUIRE(rules.leaf_size >= 1, "a leaf holds at least one node");
  same_nodes_ = source.data() == target.data() && source.extent(0) == target.extent(0);
  choose_cube(source, target, rules);
  const KeyOf key_of = make_key_of(corner_, side_, max_depth_);
  const auto sort = [&](const Nodes& nodes, Kokkos::View<int*, HostSpace>& order,
                        Kokkos::View<std::uint64_t*, HostSpace>& key) {
    const int n = nodes.extent_int(0);
    if (order.extent_int(0) != n) {
      order = Kokkos::View<int*, HostSpace>("order", n);
      key = Kokkos::View<std::uint64_t*, HostSpace>("key", n);
    }
    if (spare_order_.extent_int(0) < n) {
      spare_order_ = Kokkos::View<int*, HostSpace>("spare_order", n);
      spare_key_ = Kokkos::View<std::uint64_t*, HostSpace>("spare_key", n);
    }
    const auto keys = key;
    const auto places = order;
    Kokkos::parallel_for("skein::build_morton_keys", Kokkos::RangePolicy<HostSpace>(HostSpace(), 0, n),
                         [=](const int i) {
                           keys(i) = key_of(nodes, i);
                           places(i) = i;
                         });
    sort_by_key(key, order, n, 3 * max_depth_, spare_key_, spare_order_);
  };
  sort(source, source_order_, source_key_);
  if (same_nodes_) {
    target_order_ = source_order_;
    target_key_ = source_key_;
  } else {
    if (target_order_.data() == source_order_.data()) {
      target_order_ = {};
      target_key_ = {};
    }
    sort(target, target_order_, target_key_);
  }
  split_boxes(nodes_per_cell_);
  build_lists(rules);
}

void Octree::split_boxes(const int leaf_size) {
  boxes_.clear();
  level_first_.assign(1, 0);
  Box root;
  root.sources = {0, source_order_.extent_int(0)};
  root.targets = {0, target_order_.extent_int(0)};
  boxes_.push_back(root);
  level_first_.push_back(1);
  // First place in [run.first, run.first + run.count) whose key belongs to an octant above `octant`.
  const auto upper = [](const Kokkos::View<std::uint64_t*, HostSpace>& key, const int first, const int last,
                        const int shift, const std::uint64_t octant) {
    return static_cast<int>(
        std::upper_bound(key.data() + first, key.data() + last, octant,
                         [=](const std::uint64_t o, const std::uint64_t k) { return o < (k >> shift & 7); }) -
        key.data());
  };
  for (int level = 0; level < max_depth_; ++level) {
    const int shift = 3 * (max_depth_ - level - 1);
    // Above the aimed depth a box is split unless it holds but a leaf's worth; below, where it holds several.
    const int split_above = level + 1 <= aimed_depth_ ? (leaf_size * 5) / 4 : 3 * leaf_size;
    const int last_parent = level_first_.back();
    for (int parent = level_first_[static_cast<std::size_t>(level)]; parent < last_parent; ++parent) {
      const Box box = boxes_[static_cast<std::size_t>(parent)];
      if (math::larger(box.sources.count, box.targets.count) <= split_above) continue;
      boxes_[static_cast<std::size_t>(parent)].first_child = static_cast<int>(boxes_.size());
      int source = box.sources.first, target = box.targets.first;
      const int last_source = source + box.sources.count, last_target = target + box.targets.count;
      for (int octant = 0; octant < 8; ++octant) {
        const auto bits = static_cast<std::uint64_t>(octant);
        const int next_source = upper(source_key_, source, last_source, shift, bits);
        const int next_target = same_nodes_ ? next_source : upper(target_key_, target, last_target, shift, bits);
        if (next_source > source || next_target > target) {
          Box child;
          child.level = level + 1;
          child.parent = parent;
          child.octant = octant;
          for (int c = 0; c < 3; ++c) child.cell[c] = 2 * box.cell[c] + (octant >> c & 1);
          child.sources = {source, next_source - source};
          child.targets = {target, next_target - target};
          boxes_.push_back(child);
          ++boxes_[static_cast<std::size_t>(parent)].n_children;
        }
        source = next_source;
        target = next_target;
      }
    }
    if (static_cast<int>(boxes_.size()) == last_parent) break;
    level_first_.push_back(static_cast<int>(boxes_.size()));
  }
}

void Octree::build_lists(const OctreeRules& rules) {
  touching_.clear();
  far_.clear();
  coarse_.clear();
  coarse_direct_.clear();
  near_.clear();
  one_way_.clear();
  partners_.clear();
  fine_.clear();
  target_leaves_.clear();
  transfers_met_ = 0;
  largest_near_ = 0.0;
  std::vector<int> stack;
  for (int b = 0; b < static_cast<int>(boxes_.size()); ++b) {
    const Box& box = boxes_[static_cast<std::size_t>(b)];
    if (b == 0) touching_.entries.push_back(0);
    const int n_candidates = b == 0 ? 0 : touching_.size(box.parent);
    for (int k = 0; k < n_candidates; ++k) {
      const int a = touching_.begin(box.parent)[k];  // not kept as a pointer: entries grow
      const Box& other = boxes_[static_cast<std::size_t>(a)];
      if (other.is_leaf()) {
        if (touch(box, other)) {
          touching_.entries.push_back(a);
        } else if (other.sources.count > 0 && box.targets.count > 0) {
          const bool is_cheap = box.is_leaf() && box.targets.count < rules.min_sources_for_expansion;
          (is_cheap ? coarse_direct_ : coarse_).entries.push_back(a);
        }
        continue;
      }
      for (int i = 0; i < other.n_children; ++i) {
        const int s = other.first_child + i;
        const Box& child = boxes_[static_cast<std::size_t>(s)];
        if (touch(box, child)) {
          touching_.entries.push_back(s);
        } else if (child.sources.count > 0 && box.targets.count > 0) {
          FarPair pair{b, s, {}};
          for (int c = 0; c < 3; ++c) pair.transfer[c] = static_cast<signed char>(child.cell[c] - box.cell[c]);
          far_.entries.push_back(pair);
          transfers_met_ |= std::uint64_t{1} << transfer_index(pair.transfer);
        }
      }
    }
    touching_.end_list();
    far_.end_list();
    coarse_.end_list();
    coarse_direct_.end_list();
  }
  for (int b = 0; b < static_cast<int>(boxes_.size()); ++b) {
    const Box& box = boxes_[static_cast<std::size_t>(b)];
    if (box.is_leaf() && box.targets.count > 0) add_leaf_lists(b, rules, stack);
  }
  std::vector<int> place(boxes_.size());  // of leaves among those with targets
  for (std::size_t leaf = 0; leaf < target_leaves_.size(); ++leaf)
    place[static_cast<std::size_t>(target_leaves_[leaf])] = static_cast<int>(leaf);
  for (int& partner : partners_.entries) partner = place[static_cast<std::size_t>(partner)];
}

/// Leaves that do not touch meet across W and X lists, where both are leaves in both directions or in none: a small box
/// that is not a leaf gets an expansion from those it sends sources to.
void Octree::add_near(const int leaf, const int other) {
  const Box& box = boxes_[static_cast<std::size_t>(other)];
  near_.entries.push_back(box.sources);
  if (!same_nodes_) return;
  if (!box.is_leaf())
    one_way_.entries.push_back(box.sources);
  else if (other >= leaf)
    partners_.entries.push_back(other);
}

/// U and W: down from every box that touches the leaf.
void Octree::add_leaf_lists(const int leaf, const OctreeRules& rules, std::vector<int>& stack) {
  const Box& box = boxes_[static_cast<std::size_t>(leaf)];
  const auto first_run = static_cast<std::ptrdiff_t>(near_.entries.size());
  stack.assign(touching_.begin(leaf), touching_.end(leaf));
  for (std::size_t k = 0; k < stack.size(); ++k) {
    const Box& other = boxes_[static_cast<std::size_t>(stack[k])];
    if (other.sources.count == 0) continue;
    if (!touch(box, other)) {
      if (other.sources.count < rules.min_sources_for_expansion)
        add_near(leaf, stack[k]);
      else
        fine_.entries.push_back(stack[k]);
    } else if (other.is_leaf()) {
      add_near(leaf, stack[k]);
    } else {
      for (int i = 0; i < other.n_children; ++i) stack.push_back(other.first_child + i);
    }
  }
  for (const int* a = coarse_direct_.begin(leaf); a != coarse_direct_.end(leaf); ++a) add_near(leaf, *a);
  std::sort(near_.entries.begin() + first_run, near_.entries.end(),
            [](const Run a, const Run b) { return a.first < b.first; });
  // Neighbours in the order of the tree become one run.
  auto last = static_cast<std::size_t>(first_run);
  for (std::size_t k = last + 1; k < near_.entries.size(); ++k) {
    if (near_.entries[k].first == near_.entries[last].first + near_.entries[last].count)
      near_.entries[last].count += near_.entries[k].count;
    else
      near_.entries[++last] = near_.entries[k];
  }
  if (near_.entries.size() > static_cast<std::size_t>(first_run)) near_.entries.resize(last + 1);
  near_.end_list();
  one_way_.end_list();
  partners_.end_list();
  fine_.end_list();
  target_leaves_.push_back(leaf);
  largest_near_ = std::max(largest_near_, half_width(box.level));
}

}  // namespace skein
