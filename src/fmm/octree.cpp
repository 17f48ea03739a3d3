#include "fmm/octree.hpp"

#include <skein/core/error.hpp>

#include "fmm/morton.hpp"
#include "fmm/tree_fit.hpp"
#include "kernels/node_checks.hpp"

#include <algorithm>
#include <utility>

namespace skein {
namespace {

using Nodes = ConstVectorView<HostSpace>;

void widen(NodeBounds& bounds, const Nodes& nodes) {
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

SampledCells sample_cells(const Nodes& nodes, const KeyOf& key_of, const int stride) {
  SampledCells cells;
  cells.n_keys = math::ceil_div(nodes.extent_int(0), stride);
  std::vector<std::uint64_t> keys(static_cast<std::size_t>(cells.n_keys));
  for (int i = 0; i < cells.n_keys; ++i) keys[static_cast<std::size_t>(i)] = key_of(nodes, i * stride);
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (keys[i] != keys[i - 1]) ++cells.n_new_cells[separating_level(keys[i], keys[i - 1])];
  return cells;
}

}  // namespace

Vec3 Octree::center(const Box& box) const { return cube_.center(box); }

double Octree::bytes() const {
  const auto of_list = [](const auto& list) {
    return static_cast<double>(list.entries.capacity() * sizeof(list.entries[0]) + list.first.capacity() * sizeof(int));
  };
  const double n_places = static_cast<double>(source_order_.size()) +
                          (same_nodes_ ? 0.0 : static_cast<double>(target_order_.size())) +
                          static_cast<double>(spare_order_.size());
  const double n_keys = static_cast<double>(source_key_.size()) +
                        (same_nodes_ ? 0.0 : static_cast<double>(target_key_.size())) +
                        static_cast<double>(spare_key_.size());
  return 4.0 * n_places + 8.0 * n_keys + static_cast<double>(boxes_.capacity() * sizeof(Box)) + of_list(touching_) +
         of_list(near_) + of_list(one_way_) + of_list(partners_) + of_list(fine_) + of_list(coarse_) +
         of_list(x_direct_) + of_list(far_);
}

void Octree::choose_cube(const Nodes& source, const Nodes& target, const OctreeRules& rules) {
  NodeBounds bounds;
  widen(bounds, source);
  if (!same_nodes_) widen(bounds, target);
  const Nodes& more = source.extent(0) >= target.extent(0) ? source : target;
  cube_ = choose_octree_cube(bounds, more.extent_int(0), rules,
                             [&](const KeyOf& key_of, const int stride) { return sample_cells(more, key_of, stride); });
}

void Octree::build(const Nodes& source, const Nodes& target, const OctreeRules& rules) {
  SKEIN_REQUIRE(rules.leaf_size >= 1, "a leaf holds at least one node");
  same_nodes_ = are_same_nodes(source, target);
  choose_cube(source, target, rules);
  const KeyOf key_of = make_key_of(cube_.corner, cube_.side, cube_.max_depth);
  const auto sort = [&](const Nodes& nodes, Kokkos::View<int*, HostSpace>& order,
                        Kokkos::View<std::uint64_t*, HostSpace>& key) {
    const int n = nodes.extent_int(0);
    if (order.extent_int(0) != n || key.extent_int(0) != n) {
      order = Kokkos::View<int*, HostSpace>("skein::octree::order", n);
      key = Kokkos::View<std::uint64_t*, HostSpace>("skein::octree::key", n);
    }
    if (spare_order_.extent_int(0) < n) {
      spare_order_ = Kokkos::View<int*, HostSpace>("skein::octree::spare_order", n);
      spare_key_ = Kokkos::View<std::uint64_t*, HostSpace>("skein::octree::spare_key", n);
    }
    const auto keys = key;
    const auto places = order;
    Kokkos::parallel_for("skein::build_morton_keys", Kokkos::RangePolicy<HostSpace>(HostSpace(), 0, n),
                         [=](const int i) {
                           keys(i) = key_of(nodes, i);
                           places(i) = i;
                         });
    sort_by_key(key, order, n, 3 * cube_.max_depth, spare_key_, spare_order_);
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
  split_boxes();
  build_lists(rules);
}

void Octree::drop_keys() {
  source_key_ = {};
  target_key_ = {};
  spare_key_ = {};
  spare_order_ = {};
}

void Octree::drop_far_pairs_but(const std::vector<IndexRange>& boxes_of_level) {
  ListOfLists<FarPair> kept;
  kept.clear();
  for (int b = 0; b < static_cast<int>(boxes_.size()); ++b) {
    const IndexRange boxes = boxes_of_level[static_cast<std::size_t>(box(b).level)];
    if (b >= boxes.first && b < boxes.first + boxes.count)
      kept.entries.insert(kept.entries.end(), far_.begin(b), far_.end(b));
    kept.end_list();
  }
  kept.entries.shrink_to_fit();
  far_ = std::move(kept);
  touching_ = {};
}

bool Octree::still_fits(const Nodes& source, const Nodes& target) const {
  if (source.extent(0) != source_order_.extent(0) || target.extent(0) != target_order_.extent(0) ||
      are_same_nodes(source, target) != same_nodes_)
    return false;
  const TreeNodes<HostSpace> sources{source, source_order_}, targets{target, target_order_};
  return nodes_fit<HostSpace>(HostSpace(), Kokkos::View<const Box*, HostSpace>(boxes_.data(), boxes_.size()), cube_,
                              sources, same_nodes_ ? TreeNodes<HostSpace>() : targets);
}

void Octree::split_boxes() {
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
  for (int level = 0; level < cube_.max_depth; ++level) {
    const int shift = 3 * (cube_.max_depth - level - 1);
    const int split_above = cube_.split_above(level);
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
  x_direct_.clear();
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
          (is_cheap ? x_direct_ : coarse_).entries.push_back(a);
        }
        continue;
      }
      for (int i = 0; i < other.n_children; ++i) {
        const int s = other.first_child + i;
        const Box& child = boxes_[static_cast<std::size_t>(s)];
        if (touch(box, child)) {
          touching_.entries.push_back(s);
        } else if (child.sources.count > 0 && box.targets.count > 0) {
          far_.entries.push_back(make_far_pair(b, s, box, child));
          transfers_met_ |= std::uint64_t{1} << transfer_index(far_.entries.back().transfer);
        }
      }
    }
    touching_.end_list();
    far_.end_list();
    coarse_.end_list();
    x_direct_.end_list();
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
  for (const int* a = x_direct_.begin(leaf); a != x_direct_.end(leaf); ++a) add_near(leaf, *a);
  std::sort(near_.entries.begin() + first_run, near_.entries.end(),
            [](const IndexRange a, const IndexRange b) { return a.first < b.first; });
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
