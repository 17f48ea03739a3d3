#include "fmm/octree.hpp"

#include <algorithm>

// Where the root of a tree lies and how far it is divided, from bounds and a sample of the nodes; keys of the nodes.

namespace skein {
namespace {

template <class Space>
using Nodes = ConstVectorView<Space>;

template <class Space>
SampledCells sample_cells(const Space& space, const Nodes<Space>& nodes, const KeyOf& key_of, const int stride,
                          Octree<Space>& tree) {
  constexpr int n_levels = max_key_depth + 1;
  SampledCells cells;
  cells.n_keys = math::ceil_div(nodes.extent_int(0), stride);
  tree.sources.require(static_cast<std::size_t>(cells.n_keys));
  make_keys<Space>(space, nodes, key_of, stride, tree.sources);
  sort_by_key(space, tree.sources, cells.n_keys, 3 * max_key_depth, tree.sort_memory);
  tree.require_marks();
  const auto n_new = tree.marks;
  Kokkos::deep_copy(space, n_new, 0);
  const auto key = tree.sources.key;
  Kokkos::parallel_for(
      "skein::sample_cells", Kokkos::RangePolicy<Space>(space, 1, math::larger(1, cells.n_keys)),
      KOKKOS_LAMBDA(const int i) {
        if (key(i) != key(i - 1)) Kokkos::atomic_add(&n_new(separating_level(key(i), key(i - 1))), 1);
      });
  const FoundNumbers& found = tree.read_marks(space, n_levels);
  for (int level = 1; level < n_levels; ++level) cells.n_new_cells[level] = found(level);
  return cells;
}

}  // namespace

template <class Space>
void make_keys(const Space& space, const ConstVectorView<Space>& nodes, const KeyOf& key_of, const int stride,
               const KeyedOrder<Space>& keyed) {
  const auto key = keyed.key;
  const auto order = keyed.order;
  launch<Space>(
      "skein::make_morton_keys", space, Calls{math::ceil_div(nodes.extent_int(0), stride), 6.0},
      KOKKOS_LAMBDA(const int i) {
        key(i) = key_of(nodes, i * stride);
        order(i) = i;
      });
}

template <class Space>
OctreeCube choose_cube(const Space& space, Octree<Space>& tree, const ConstVectorView<Space>& source,
                       const ConstVectorView<Space>& target, const NodeBounds& bounds) {
  const Nodes<Space>& more = source.extent(0) >= target.extent(0) ? source : target;
  return choose_octree_cube(bounds, more.extent_int(0), tree.rules, [&](const KeyOf& key_of, const int stride) {
    return sample_cells<Space>(space, more, key_of, stride, tree);
  });
}

#define SKEIN_INSTANTIATE(S)                                                                                     \
  template void make_keys<S>(const S&, const ConstVectorView<S>&, const KeyOf&, int, const KeyedOrder<S>&);      \
  template OctreeCube choose_cube<S>(const S&, Octree<S>&, const ConstVectorView<S>&, const ConstVectorView<S>&, \
                                     const NodeBounds&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
