#include "fmm/device_list_source.hpp"

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

/// The box that follows in a walk through everything below `root`, which leaves out what is below `box`; root at the
/// end. Boxes have no siblings but their parent's children, which stand together.
template <class Space>
KOKKOS_INLINE_FUNCTION int next_box(const ListSource<Space>& from, int box, const int root) {
  while (box != root) {
    const int parent = from.boxes(box).parent;
    if (box + 1 < from.boxes(parent).first_child + from.boxes(parent).n_children) return box + 1;
    box = parent;
  }
  return root;
}

/// U and W: down from every box that touches the leaf.
template <class Space>
KOKKOS_INLINE_FUNCTION void list_near(const ListSource<Space>& from, const int leaf,
                                      const int min_sources_for_expansion, RunSink& near, EntrySink<int>& fine) {
  const Box box = from.boxes(leaf);
  const IndexRange around = from.touching_of(leaf);
  for (int k = around.first; k < around.first + around.count; ++k) {
    const int root = from.touching(k);
    int b = root;
    do {
      const Box other = from.boxes(b);
      bool goes_down = false;
      if (other.sources.count > 0) {
        if (!touch(box, other)) {
          if (other.sources.count < min_sources_for_expansion)
            near.add(other.sources);
          else
            fine.add(b);
        } else if (other.is_leaf()) {
          near.add(other.sources);
        } else {
          goes_down = true;
        }
      }
      b = goes_down ? other.first_child : next_box(from, b, root);
    } while (b != root);
  }
  for (int k = from.direct_first(leaf); k < from.direct_first(leaf + 1); ++k)
    near.add(from.boxes(from.direct(k)).sources);
}

template <class Space>
void find_target_leaves(const Space& space, DeviceOctree<Space>& tree) {
  const int n_boxes = tree.n_boxes();
  require_extent(tree.count, static_cast<std::size_t>(n_boxes) + 1, "skein::device_near_lists::box_count");
  const auto place = tree.count;
  const auto boxes = tree.boxes;
  int coarsest = 0;
  Kokkos::parallel_reduce(
      "skein::find_target_leaves", Kokkos::RangePolicy<Space>(space, 0, n_boxes),
      KOKKOS_LAMBDA(const int b, int& least) {
        const Box& box = boxes(b);
        place(b) = box.is_leaf() && box.targets.count > 0;
        if (place(b) == 1) least = math::smaller(least, box.level);
      },
      Kokkos::Min<int>(coarsest));
  tree.n_target_leaves = scan_counts(space, tree.count, 0, n_boxes, 0);
  tree.largest_leaf = tree.n_target_leaves > 0 ? tree.half_width(coarsest) : 0.0;
  require_extent(tree.target_leaves, static_cast<std::size_t>(tree.n_target_leaves),
                 "skein::device_near_lists::target_leaves");
  const auto leaves = tree.target_leaves;
  Kokkos::parallel_for(
      "skein::list_target_leaves", Kokkos::RangePolicy<Space>(space, 0, n_boxes), KOKKOS_LAMBDA(const int b) {
        if (place(b + 1) > place(b)) leaves(place(b)) = b;
      });
}

template <class Space>
void build_near(const Space& space, DeviceOctree<Space>& tree, const int min_sources_for_expansion) {
  const int n_leaves = tree.n_target_leaves;
  const auto n_first = static_cast<std::size_t>(n_leaves) + 1;
  require_extent(tree.u_list.first, n_first, "skein::device_near_lists::u_first");
  require_extent(tree.w_list.first, n_first, "skein::device_near_lists::w_first");
  require_extent(tree.near_end, n_first, "skein::device_near_lists::near_end");
  const ListSource<Space> from(tree);
  const auto leaves = tree.target_leaves;
  const auto near_end = tree.near_end;
  for (const bool fills : {false, true}) {
    const auto near = tree.u_list;
    const auto fine = tree.w_list;
    std::int64_t n_pairs = 0;
    Kokkos::parallel_reduce(
        "skein::list_near", Kokkos::RangePolicy<Space>(space, 0, n_leaves),
        KOKKOS_LAMBDA(const int leaf, std::int64_t& sum) {
          RunSink runs;
          EntrySink<int> boxes;
          if (fills) {
            runs.to = near.entries.data() + near.first(leaf);
            boxes.to = fine.entries.data() + fine.first(leaf);
          }
          list_near(from, leaves(leaf), min_sources_for_expansion, runs, boxes);
          if (fills) {
            runs.put_in_order();
            near_end(leaf) = near.first(leaf) + runs.n;
            for (int k = 0; k < runs.n; ++k)
              sum += static_cast<std::int64_t>(runs.to[k].count) * from.boxes(leaves(leaf)).targets.count;
          } else {
            near.first(leaf) = runs.n;
            fine.first(leaf) = boxes.n;
          }
        },
        n_pairs);
    tree.n_near_pairs = static_cast<double>(n_pairs);
    if (fills) continue;
    place_lists(space, tree, n_leaves, "skein::device_near_lists::list", tree.u_list, tree.w_list);
  }
}

template <class Space>
void list_leaf_parts(const Space& space, DeviceOctree<Space>& tree) {
  const int n_leaves = tree.n_target_leaves;
  require_extent(tree.part_first, static_cast<std::size_t>(n_leaves) + 1, "skein::device_near_lists::part_first");
  const auto first = tree.part_first;
  const auto boxes = tree.boxes;
  const auto leaves = tree.target_leaves;
  Kokkos::parallel_for(
      "skein::count_leaf_parts", Kokkos::RangePolicy<Space>(space, 0, n_leaves),
      KOKKOS_LAMBDA(const int i) { first(i) = math::ceil_div(boxes(leaves(i)).targets.count, part_targets); });
  tree.n_parts = scan_counts(space, first, 0, n_leaves, 0);
  require_extent(tree.part_leaf, static_cast<std::size_t>(tree.n_parts), "skein::device_near_lists::part_leaf");
  require_extent(tree.part_place, static_cast<std::size_t>(tree.n_parts), "skein::device_near_lists::part_place");
  const auto leaf = tree.part_leaf, place = tree.part_place;
  Kokkos::parallel_for(
      "skein::list_leaf_parts", Kokkos::RangePolicy<Space>(space, 0, n_leaves), KOKKOS_LAMBDA(const int i) {
        for (int k = first(i); k < first(i + 1); ++k) {
          leaf(k) = i;
          place(k) = k - first(i);
        }
      });
}

}  // namespace

template <class Space>
void build_near_lists(const Space& space, DeviceOctree<Space>& tree, const OctreeRules& rules) {
  find_target_leaves(space, tree);
  build_near(space, tree, rules.min_sources_for_expansion);
  list_leaf_parts(space, tree);
}

#define SKEIN_INSTANTIATE(S) template void build_near_lists<S>(const S&, DeviceOctree<S>&, const OctreeRules&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
