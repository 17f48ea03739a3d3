#include "fmm/device_nodes.hpp"

namespace skein {

template <class Space>
double DeviceNodes<Space>::bytes() const {
  const std::size_t n_targets = target.data() == position.data() ? 0 : target.size();
  return 8.0 * static_cast<double>(position.size() + force.size() + blob.size() + n_targets);
}

template <class Space>
void sort_nodes(const Space& space, const Octree<Space>& tree, const UnsortedNodes<Space>& nodes, const double scale,
                DeviceNodes<Space>& sorted) {
  const auto n_sources = static_cast<std::size_t>(tree.n_sources), n_targets = static_cast<std::size_t>(tree.n_targets);
  if (sorted.target.data() == sorted.position.data()) sorted.target = {};
  require_extent(sorted.position, n_sources, "skein::device_nodes::sorted_position");
  require_extent(sorted.force, n_sources, "skein::device_nodes::sorted_force");
  require_extent(sorted.blob, n_sources, "skein::device_nodes::sorted_blob");
  if (tree.same_nodes)
    sorted.target = sorted.position;
  else
    require_extent(sorted.target, n_targets, "skein::device_nodes::sorted_target");
  const UnsortedNodes<Space> from = nodes;
  const DeviceNodes<Space> to = sorted;
  const auto source_order = tree.source_order(), target_order = tree.target_order();
  Kokkos::parallel_for(
      "skein::sort_sources", Kokkos::RangePolicy<Space>(space, 0, tree.n_sources), KOKKOS_LAMBDA(const int i) {
        const int at = source_order(i);
        store(to.position, i, load(from.position, at));
        store(to.force, i, scale * load(from.force, at));
        to.blob(i) = from.blob(at);
      });
  if (!tree.same_nodes)
    Kokkos::parallel_for(
        "skein::sort_targets", Kokkos::RangePolicy<Space>(space, 0, tree.n_targets),
        KOKKOS_LAMBDA(const int i) { store(to.target, i, load(from.target, target_order(i))); });
}

#define SKEIN_INSTANTIATE(S)                     \
  template double DeviceNodes<S>::bytes() const; \
  template void sort_nodes<S>(const S&, const Octree<S>&, const UnsortedNodes<S>&, double, DeviceNodes<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
