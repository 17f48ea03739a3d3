#include "fmm/octree.hpp"

#include <algorithm>

// Where the root of a tree lies and how far it is divided, from bounds and a sample of the nodes; keys of the nodes.

namespace skein {
namespace {

template <class Space>
using Nodes = ConstVectorView<Space>;

/// The extremes of a run of coordinates, or of one on a device; several at a time, because each waits for the one
/// before.
template <class Space>
struct FindBounds {
  using Extremes = Kokkos::MinMax<double>;
  static constexpr int lanes = on_host<Space> ? 16 : 1, run = on_host<Space> ? 2048 : 1;

  Nodes<Space> nodes;
  int axis;

  KOKKOS_INLINE_FUNCTION void operator()(const int k, typename Extremes::value_type& extremes) const {
    const int n = nodes.extent_int(0), first = k * run, end = math::smaller(n, first + run);
    double low[lanes], high[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
      low[lane] = NodeBounds::most;
      high[lane] = -NodeBounds::most;
    }
    int i = first;
    for (; i + lanes <= end; i += lanes)
      for (int lane = 0; lane < lanes; ++lane) {
        const double x = nodes(i + lane, axis);
        low[lane] = x < low[lane] ? x : low[lane];
        high[lane] = x > high[lane] ? x : high[lane];
      }
    for (; i < end; ++i) {
      const double x = nodes(i, axis);
      low[0] = x < low[0] ? x : low[0];
      high[0] = x > high[0] ? x : high[0];
    }
    for (int lane = 0; lane < lanes; ++lane) {
      extremes.min_val = low[lane] < extremes.min_val ? low[lane] : extremes.min_val;
      extremes.max_val = high[lane] > extremes.max_val ? high[lane] : extremes.max_val;
    }
  }
};

template <class Space>
SampledCells sample_cells(const Space& space, const Nodes<Space>& nodes, const KeyOf& key_of, const int stride,
                          KeyedOrder<Space>& keyed, SortSpace<Space>& memory) {
  SampledCells cells;
  cells.n_keys = math::ceil_div(nodes.extent_int(0), stride);
  keyed.require(static_cast<std::size_t>(cells.n_keys));
  make_keys<Space>(space, nodes, key_of, stride, keyed);
  sort_by_key(space, keyed, cells.n_keys, 3 * max_key_depth, memory);
  const Kokkos::View<int*, Space> n_new("skein::octree::sampled_cells", max_key_depth + 1);
  const auto key = keyed.key;
  Kokkos::parallel_for(
      "skein::sample_cells", Kokkos::RangePolicy<Space>(space, 1, math::larger(1, cells.n_keys)),
      KOKKOS_LAMBDA(const int i) {
        if (key(i) != key(i - 1)) Kokkos::atomic_add(&n_new(separating_level(key(i), key(i - 1))), 1);
      });
  space.fence();
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), n_new);
  for (int level = 1; level <= max_key_depth; ++level) cells.n_new_cells[level] = host(level);
  return cells;
}

}  // namespace

template <class Space>
void widen_bounds(const Space& space, const ConstVectorView<Space>& nodes, NodeBounds& bounds) {
  using Find = FindBounds<Space>;
  const Calls runs{math::ceil_div(nodes.extent_int(0), Find::run), 0.7 * Find::run};
  for (int c = 0; c < 3; ++c) {
    typename Find::Extremes::value_type found;
    launch_reduction<Space>("skein::find_bounds", space, runs, Find{nodes, c}, typename Find::Extremes(found));
    bounds.low[c] = std::min(bounds.low[c], found.min_val);
    bounds.high[c] = std::max(bounds.high[c], found.max_val);
  }
}

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
                       const ConstVectorView<Space>& target) {
  NodeBounds bounds;
  widen_bounds<Space>(space, source, bounds);
  if (!tree.same_nodes) widen_bounds<Space>(space, target, bounds);
  const Nodes<Space>& more = source.extent(0) >= target.extent(0) ? source : target;
  return choose_octree_cube(bounds, more.extent_int(0), tree.rules, [&](const KeyOf& key_of, const int stride) {
    return sample_cells<Space>(space, more, key_of, stride, tree.sources, tree.sort_memory);
  });
}

#define SKEIN_INSTANTIATE(S)                                                                                \
  template void widen_bounds<S>(const S&, const ConstVectorView<S>&, NodeBounds&);                          \
  template void make_keys<S>(const S&, const ConstVectorView<S>&, const KeyOf&, int, const KeyedOrder<S>&); \
  template OctreeCube choose_cube<S>(const S&, Octree<S>&, const ConstVectorView<S>&, const ConstVectorView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
