#include "sum_order.hpp"

#include "kernels/node_checks.hpp"

#include <algorithm>
#include <string>

namespace skein {
namespace {

void send_vectors(Communicator& ranks, const ConstVectors& vectors) {
  // Some nodes of an array have gaps between their components.
  ConstVectors packed = vectors;
  if (!vectors.span_is_contiguous()) {
    const Vectors copy("skein::send_vectors::packed", vectors.extent(0));
    Kokkos::deep_copy(copy, vectors);
    packed = copy;
  }
  const auto on_host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), packed);
  // Of rank 0 nothing is changed.
  ranks.broadcast(const_cast<double*>(on_host.data()), on_host.size() * sizeof(double));
}

template <class View>
void receive(Communicator& ranks, View& array, const int n, const char* label) {
  if (array.extent_int(0) != n) array = View(std::string(label), static_cast<std::size_t>(n));
  const auto mirror = Kokkos::create_mirror_view(array);
  ranks.broadcast(mirror.data(), mirror.size() * sizeof(double));
  Kokkos::deep_copy(array, mirror);
}

}  // namespace

void send_nodes(Communicator& ranks, SumOrder& order, const Sources& sources, const ConstVectors& target) {
  order.n_sources = sources.position.extent_int(0);
  order.n_targets = target.extent_int(0);
  order.are_same_nodes = are_same_nodes(sources.position, target);
  if (order.n_sources > 0) {
    const BlobRange blobs = find_blob_range<ExecSpace>(ExecSpace(), sources.blob);
    order.has_one_blob = blobs.smallest == blobs.largest;
    order.blob = blobs.largest;
  }
  ranks.broadcast(&order, sizeof order);
  send_vectors(ranks, sources.position);
  send_vectors(ranks, sources.force);
  if (!order.are_same_nodes) send_vectors(ranks, target);
  if (order.has_one_blob) return;
  const auto blob = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sources.blob);
  ranks.broadcast(const_cast<double*>(blob.data()), blob.size() * sizeof(double));
}

void receive_nodes(Communicator& ranks, const SumOrder& order, OrderedNodes& nodes) {
  receive(ranks, nodes.position, order.n_sources, "skein::receive_nodes::position");
  receive(ranks, nodes.force, order.n_sources, "skein::receive_nodes::force");
  if (order.are_same_nodes) {
    nodes.target = nodes.position;
  } else {
    if (nodes.target.data() == nodes.position.data()) nodes.target = {};
    receive(ranks, nodes.target, order.n_targets, "skein::receive_nodes::target");
  }
  if (!order.has_one_blob) return receive(ranks, nodes.blob, order.n_sources, "skein::receive_nodes::blob");
  if (nodes.blob.extent_int(0) != order.n_sources)
    nodes.blob = Scalars("skein::receive_nodes::blob", static_cast<std::size_t>(order.n_sources));
  Kokkos::deep_copy(nodes.blob, order.blob);
}

}  // namespace skein
