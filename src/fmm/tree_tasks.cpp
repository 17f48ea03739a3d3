#include "fmm/tree_tasks.hpp"

#include "fmm/fmm_operator_set.hpp"

#include <utility>

namespace skein {

template <class Space>
void LeafParts<Space>::build(const Space& space, const Octree<Space>& tree, const int most_targets,
                             const IndexRange wanted) {
  n_leaves = tree.n_target_leaves;
  require_extent(first, static_cast<std::size_t>(n_leaves) + 1, "skein::leaf_parts::first");
  const auto boxes = tree.boxes;
  const auto leaves = tree.target_leaves;
  const auto begin = first;
  launch<Space>(
      "skein::count_leaf_parts", space, Calls{n_leaves, 3.0}, KOKKOS_LAMBDA(const int i) {
        const IndexRange targets = boxes(leaves(i)).targets;
        const bool is_wanted = targets.first >= wanted.first && targets.first < wanted.first + wanted.count;
        begin(i) = is_wanted ? math::ceil_div(targets.count, most_targets) : 0;
      });
  scan_in_place(space, first, n_leaves);
  n_parts = tree.defers_counts ? n_leaves + tree.n_targets / most_targets : read_number(first, n_leaves);
  require_extent(leaf, static_cast<std::size_t>(n_parts), "skein::leaf_parts::leaf");
  require_extent(place, static_cast<std::size_t>(n_parts), "skein::leaf_parts::place");
  const auto leaf_of = leaf, place_of = place;
  launch<Space>(
      "skein::list_leaf_parts", space, Calls{n_leaves, 3.0}, KOKKOS_LAMBDA(const int i) {
        for (int k = begin(i); k < begin(i + 1); ++k) {
          leaf_of(k) = i;
          place_of(k) = k - begin(i);
        }
      });
}

template <class Space>
void FarOrder<Space>::build(const Space& space, Octree<Space>& tree) {
  constexpr int n_bits = 11;  // of a level and an index
  static_assert((max_key_depth + 1) * n_transfers <= 1 << n_bits);
  const int n = tree.v_list.n_entries;
  n_pairs = n_kept = n;
  targets = {0, tree.n_targets};
  pairs.require(static_cast<std::size_t>(n));
  require_extent(place, static_cast<std::size_t>(n), "skein::far_order::place");
  const auto boxes = tree.boxes;
  const auto far = tree.v_list.entries;
  const auto key = pairs.key;
  const auto unsorted = pairs.order;
  launch<Space>(
      "skein::make_transfer_keys", space, Calls{n, 5.0}, KOKKOS_LAMBDA(const int k) {
        const FarPair pair = far(k);
        key(k) = static_cast<std::uint64_t>(n_transfers * boxes(pair.target).level + transfer_index(pair.transfer));
        unsorted(k) = k;
      });
  sort_by_key(space, pairs, n, n_bits, tree.sort_memory);
  const auto order = pairs.order, place_of = place;
  launch<Space>(
      "skein::place_far_pairs", space, Calls{n, 3.0}, KOKKOS_LAMBDA(const int i) { place_of(order(i)) = i; });
}

template <class Space>
void FarOrder<Space>::keep(const Space& space, Octree<Space>& tree, const IndexRange own) {
  if (own.first == 0 && own.count == tree.n_targets) return;
  const int n = n_pairs;
  targets = own;
  require_extent(n_before_, static_cast<std::size_t>(n) + 1, "skein::far_order::n_before");
  const auto n_before = n_before_;
  const auto boxes = tree.boxes;
  const auto far = tree.v_list.entries;
  const auto all = pairs;
  launch<Space>(
      "skein::mark_own_far_pairs", space, Calls{n, 5.0},
      KOKKOS_LAMBDA(const int i) { n_before(i) = overlap(boxes(far(all.order(i)).target).targets, own); });
  n_kept = scan_counts(space, n_before_, n);
  KeyedOrder<Space>& spare = tree.sort_memory.spare;
  spare.require(static_cast<std::size_t>(n_kept));
  const auto kept = spare;
  const auto place_of = place;
  launch<Space>(
      "skein::keep_own_far_pairs", space, Calls{n, 5.0}, KOKKOS_LAMBDA(const int i) {
        const int to = n_before(i);
        if (n_before(i + 1) == to) return;
        kept.key(to) = all.key(i);
        kept.order(to) = all.order(i);
        place_of(all.order(i)) = to;
      });
  std::swap(pairs, spare);
}

template <class Space>
std::vector<int> FarOrder<Space>::cut(const int n_at_once) const {
  std::vector<int> edges;
  for (int first = 0; first < n_pairs; first += n_at_once) {
    edges.push_back(first);
    if (n_kept < n_pairs && first > 0) Kokkos::deep_copy(edges.back(), Kokkos::subview(n_before_, first));
  }
  edges.push_back(n_kept);
  return edges;
}

template <class Space>
void count_near_pairs(const Space& space, const Octree<Space>& tree, const ScalarView<Space>& n_pairs) {
  const auto boxes = tree.boxes;
  const auto leaves = tree.target_leaves;
  const auto near = tree.u_list;
  const auto near_end = tree.near_end;
  launch<Space>(
      "skein::count_near_pairs", space, Calls{tree.n_target_leaves, 50.0}, KOKKOS_LAMBDA(const int leaf) {
        double n_sources = 0.0;
        for (int k = near.first(leaf); k < near_end(leaf); ++k) n_sources += near.entries(k).count;
        n_pairs(leaf) = n_sources * boxes(leaves(leaf)).targets.count;
      });
}

#define SKEIN_INSTANTIATE(S)    \
  template struct LeafParts<S>; \
  template struct FarOrder<S>;  \
  template void count_near_pairs<S>(const S&, const Octree<S>&, const ScalarView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
