#include "fmm/octree_walk.hpp"

namespace skein {
namespace {

/// Runs of sources; one that begins where the last one ended prolongs it.
struct RunSink {
  IndexRange* to = nullptr;
  int n = 0;
  IndexRange last;

  KOKKOS_INLINE_FUNCTION void add(const IndexRange& run) {
    if (n > 0 && run.first == last.first + last.count) {
      last.count += run.count;
    } else {
      last = run;
      ++n;
    }
    if (to != nullptr) to[n - 1] = last;
  }

  /// Sorts the runs, of which there are few, and joins neighbours.
  KOKKOS_INLINE_FUNCTION void put_in_order() {
    for (int i = 1; i < n; ++i) {
      const IndexRange run = to[i];
      int k = i;
      for (; k > 0 && to[k - 1].first > run.first; --k) to[k] = to[k - 1];
      to[k] = run;
    }
    const int n_before = n;
    n = 0;
    for (int i = 0; i < n_before; ++i) add(IndexRange(to[i]));
  }
};

/// U and W of a leaf.
struct NearSinks {
  RunSink runs;
  EntrySink<int> boxes;
  KOKKOS_INLINE_FUNCTION void near(int /*b*/, const Box& box) { runs.add(box.sources); }
  KOKKOS_INLINE_FUNCTION void fine(const int b) { boxes.add(b); }
};

/// Leaves with targets have places in tree.count, which ends with their number.
template <class Space>
void find_target_leaves(const Space& space, Octree<Space>& tree) {
  const int n_boxes = tree.n_boxes();
  require_extent(tree.count, static_cast<std::size_t>(n_boxes) + 1, "skein::octree::box_count");
  const auto place = tree.count;
  const auto boxes = tree.boxes;
  launch_reduction<Space>(
      "skein::find_target_leaves", space, Calls{n_boxes, 3.0},
      KOKKOS_LAMBDA(const int b, int& least) {
        const Box& box = boxes(b);
        place(b) = box.is_leaf() && box.targets.count > 0;
        if (place(b) == 1) least = math::smaller(least, box.level);
      },
      Kokkos::Min<int, SharedHostMemory>(tree.totals.coarsest_leaf));
  scan_in_place(space, tree.count, n_boxes);
  require_extent(tree.target_leaves, static_cast<std::size_t>(n_boxes), "skein::octree::target_leaves");
  const auto leaves = tree.target_leaves;
  const auto n_leaves = tree.totals.n_target_leaves;
  launch<Space>(
      "skein::list_target_leaves", space, Calls{n_boxes, 3.0}, KOKKOS_LAMBDA(const int b) {
        if (place(b + 1) > place(b)) leaves(place(b)) = b;
        if (b == n_boxes - 1) n_leaves() = place(n_boxes);
      });
}

/// The number of target leaves; where that is not looked at yet, one that it is not above.
template <class Space>
int bound_target_leaves(const Space& space, const Octree<Space>& tree) {
  if (tree.defers_counts) return tree.n_boxes();
  wait_for(space);
  return tree.totals.n_target_leaves();
}

template <class Space>
void build_near(const Space& space, Octree<Space>& tree, const int min_sources_for_expansion) {
  const int n_boxes = tree.n_boxes(), n_most = bound_target_leaves(space, tree);
  const auto n_first = static_cast<std::size_t>(n_most) + 1;
  require_extent(tree.u_list.first, n_first, "skein::octree::u_first");
  require_extent(tree.w_list.first, n_first, "skein::octree::w_first");
  require_extent(tree.near_end, n_first, "skein::octree::near_end");
  const ListSource<Space> from(tree);
  const auto leaves = tree.target_leaves;
  const auto place = tree.count;
  const auto near_first = tree.u_list.first, fine_first = tree.w_list.first;
  launch<Space>(
      "skein::count_near", space, Calls{n_most, 800.0}, KOKKOS_LAMBDA(const int leaf) {
        NearSinks sinks;
        if (leaf < place(n_boxes)) visit_near(from, leaves(leaf), min_sources_for_expansion, sinks);
        near_first(leaf) = sinks.runs.n;
        fine_first(leaf) = sinks.boxes.n;
      });
  place_lists(space, tree, n_most, FoundTotals::u, tree.u_list, tree.w_list);
  const auto near = tree.u_list;
  const auto fine = tree.w_list;
  const auto near_end = tree.near_end;
  launch_reduction<Space>(
      "skein::list_near", space, Calls{n_most, 800.0},
      KOKKOS_LAMBDA(const int leaf, std::int64_t& sum) {
        if (leaf >= place(n_boxes) || !near.has_room(n_most)) return;
        NearSinks sinks;
        RunSink& runs = sinks.runs;
        runs.to = near.entries.data() + near.first(leaf);
        if (fine.has_room(n_most)) sinks.boxes.to = fine.entries.data() + fine.first(leaf);
        visit_near(from, leaves(leaf), min_sources_for_expansion, sinks);
        runs.put_in_order();
        near_end(leaf) = near.first(leaf) + runs.n;
        for (int k = 0; k < runs.n; ++k)
          sum += static_cast<std::int64_t>(runs.to[k].count) * from.boxes(leaves(leaf)).targets.count;
      },
      Kokkos::Sum<std::int64_t, SharedHostMemory>(tree.totals.near_pairs));
}

}  // namespace

template <class Space>
void build_near_lists(const Space& space, Octree<Space>& tree) {
  find_target_leaves(space, tree);
  build_near(space, tree, tree.rules.min_sources_for_expansion);
}

#define SKEIN_INSTANTIATE(S) template void build_near_lists<S>(const S&, Octree<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
