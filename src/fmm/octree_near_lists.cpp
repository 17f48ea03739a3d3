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

template <class Space>
void find_target_leaves(const Space& space, Octree<Space>& tree) {
  const int n_boxes = tree.n_boxes();
  require_extent(tree.count, static_cast<std::size_t>(n_boxes) + 1, "skein::octree::box_count");
  const auto place = tree.count;
  const auto boxes = tree.boxes;
  int coarsest = 0;
  launch_reduction<Space>(
      "skein::find_target_leaves", space, Calls{n_boxes, 3.0},
      KOKKOS_LAMBDA(const int b, int& least) {
        const Box& box = boxes(b);
        place(b) = box.is_leaf() && box.targets.count > 0;
        if (place(b) == 1) least = math::smaller(least, box.level);
      },
      Kokkos::Min<int>(coarsest));
  tree.n_target_leaves = scan_counts(space, tree.count, 0, n_boxes, 0);
  tree.largest_leaf = tree.n_target_leaves > 0 ? tree.half_width(coarsest) : 0.0;
  require_extent(tree.target_leaves, static_cast<std::size_t>(tree.n_target_leaves), "skein::octree::target_leaves");
  const auto leaves = tree.target_leaves;
  launch<Space>(
      "skein::list_target_leaves", space, Calls{n_boxes, 3.0}, KOKKOS_LAMBDA(const int b) {
        if (place(b + 1) > place(b)) leaves(place(b)) = b;
      });
}

template <class Space>
void build_near(const Space& space, Octree<Space>& tree, const int min_sources_for_expansion) {
  const int n_leaves = tree.n_target_leaves;
  const auto n_first = static_cast<std::size_t>(n_leaves) + 1;
  require_extent(tree.u_list.first, n_first, "skein::octree::u_first");
  require_extent(tree.w_list.first, n_first, "skein::octree::w_first");
  require_extent(tree.near_end, n_first, "skein::octree::near_end");
  const ListSource<Space> from(tree);
  const auto leaves = tree.target_leaves;
  const auto near_end = tree.near_end;
  for (const bool fills : {false, true}) {
    const auto near = tree.u_list;
    const auto fine = tree.w_list;
    std::int64_t n_pairs = 0;
    launch_reduction<Space>(
        "skein::list_near", space, Calls{n_leaves, 800.0},
        KOKKOS_LAMBDA(const int leaf, std::int64_t& sum) {
          NearSinks sinks;
          RunSink& runs = sinks.runs;
          if (fills) {
            runs.to = near.entries.data() + near.first(leaf);
            sinks.boxes.to = fine.entries.data() + fine.first(leaf);
          }
          visit_near(from, leaves(leaf), min_sources_for_expansion, sinks);
          if (fills) {
            runs.put_in_order();
            near_end(leaf) = near.first(leaf) + runs.n;
            for (int k = 0; k < runs.n; ++k)
              sum += static_cast<std::int64_t>(runs.to[k].count) * from.boxes(leaves(leaf)).targets.count;
          } else {
            near.first(leaf) = runs.n;
            fine.first(leaf) = sinks.boxes.n;
          }
        },
        Kokkos::Sum<std::int64_t>(n_pairs));
    tree.n_near_pairs = static_cast<double>(n_pairs);
    if (fills) continue;
    place_lists(space, tree, n_leaves, "skein::octree::list", tree.u_list, tree.w_list);
  }
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
