#include "fmm/sorted_nodes.hpp"

#include <skein/fmm/even_sample.hpp>

namespace skein {

template <class Space>
double SortedNodes<Space>::bytes() const {
  const std::size_t n_targets = target.data() == position.data() ? 0 : target.size();
  return 8.0 * static_cast<double>(position.size() + force.size() + blob.size() + n_targets);
}

template <class Space>
void require_nodes(const Octree<Space>& tree, SortedNodes<Space>& sorted) {
  const auto n_sources = static_cast<std::size_t>(tree.n_sources), n_targets = static_cast<std::size_t>(tree.n_targets);
  if (sorted.target.data() == sorted.position.data()) sorted.target = {};
  require_extent(sorted.position, n_sources, "skein::sorted_nodes::position");
  require_extent(sorted.force, n_sources, "skein::sorted_nodes::force");
  require_extent(sorted.blob, n_sources, "skein::sorted_nodes::blob");
  if (tree.same_nodes)
    sorted.target = sorted.position;
  else
    require_extent(sorted.target, n_targets, "skein::sorted_nodes::target");
}

template <class Space>
void sort_nodes(const Space& space, const Octree<Space>& tree, const UnsortedNodes<Space>& nodes, const double scale,
                const IndexRange sources, const IndexRange targets, const SortedNodes<Space>& sorted) {
  const UnsortedNodes<Space> from = nodes;
  const SortedNodes<Space> to = sorted;
  const auto source_order = tree.source_order(), target_order = tree.target_order();
  Kokkos::parallel_for(
      "skein::sort_sources", Kokkos::RangePolicy<Space>(space, sources.first, sources.first + sources.count),
      KOKKOS_LAMBDA(const int i) {
        const int at = source_order(i);
        store(to.position, i, load(from.position, at));
        store(to.force, i, scale * load(from.force, at));
        to.blob(i) = from.blob(at);
      });
  if (!tree.same_nodes)
    Kokkos::parallel_for(
        "skein::sort_targets", Kokkos::RangePolicy<Space>(space, targets.first, targets.first + targets.count),
        KOKKOS_LAMBDA(const int i) { store(to.target, i, load(from.target, target_order(i))); });
}

template <class Space>
void pack_vectors(const Space& space, const ConstVectorView<Space>& vectors,
                  const Kokkos::View<const int*, Space>& list, const ScalarView<Space>& packed) {
  launch<Space>(
      "skein::pack_vectors", space, Calls{list.extent_int(0), 10.0}, KOKKOS_LAMBDA(const int i) {
        for (int c = 0; c < 3; ++c) packed(3 * i + c) = vectors(list(i), c);
      });
}

template <class Space>
void unpack_vectors(const Space& space, const ConstScalarView<Space>& packed,
                    const Kokkos::View<const int*, Space>& list, const VectorView<Space>& vectors) {
  launch<Space>(
      "skein::unpack_vectors", space, Calls{list.extent_int(0), 10.0}, KOKKOS_LAMBDA(const int i) {
        for (int c = 0; c < 3; ++c) vectors(list(i), c) = packed(3 * i + c);
      });
}

template <class Space>
std::vector<Vec3> read_sample(const Space& space, const ConstVectorView<Space>& vectors, const EvenSample& sample) {
  const VectorView<Space> chosen("skein::even_sample::sample", sample.n_chosen);
  Kokkos::parallel_for(
      "skein::read_sample", Kokkos::RangePolicy<Space>(space, 0, sample.n_chosen),
      KOKKOS_LAMBDA(const int i) { store(chosen, i, load(vectors, sample.index(i))); });
  space.fence();
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), chosen);
  std::vector<Vec3> list;
  for (int i = 0; i < sample.n_chosen; ++i) list.push_back(load(host, i));
  return list;
}

#define SKEIN_INSTANTIATE(S)                                                                                       \
  template double SortedNodes<S>::bytes() const;                                                                   \
  template void require_nodes<S>(const Octree<S>&, SortedNodes<S>&);                                               \
  template void sort_nodes<S>(const S&, const Octree<S>&, const UnsortedNodes<S>&, double, IndexRange, IndexRange, \
                              const SortedNodes<S>&);                                                              \
  template void pack_vectors<S>(const S&, const ConstVectorView<S>&, const Kokkos::View<const int*, S>&,           \
                                const ScalarView<S>&);                                                             \
  template void unpack_vectors<S>(const S&, const ConstScalarView<S>&, const Kokkos::View<const int*, S>&,         \
                                  const VectorView<S>&);                                                           \
  template std::vector<Vec3> read_sample<S>(const S&, const ConstVectorView<S>&, const EvenSample&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
