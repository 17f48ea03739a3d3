#include "kernels/node_checks.hpp"
#include "node_parts.hpp"
#include "sum_order.hpp"
#include "sum_server.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace skein {

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

Sources rows_of(const Sources& sources, const std::size_t first, const std::size_t n) {
  const auto rows = std::make_pair(first, first + n);
  return {Kokkos::subview(sources.position, rows, Kokkos::ALL()), Kokkos::subview(sources.force, rows, Kokkos::ALL()),
          Kokkos::subview(sources.blob, rows)};
}

Vectors Delivery::own_rows() const { return rows_of(room, 0, owners.count[0]); }

void TeamLink::send(SumOrder& order) {
  order.gathers_positions = order.gathers_forces = false;
  post(order);
}

void TeamLink::post(SumOrder& order) {
  // What does not go with the order goes before it: nothing is sent where work is noted, so that notes can be taken
  // when other ranks are lost.
  std::size_t n_sent = 0;
  for (; works_.size() - n_sent > SumOrder::most_works; n_sent += SumOrder::most_works) {
    SumOrder before;
    before.kind = SumOrder::Kind::work_on_parts;
    before.take_works(works_.data() + n_sent, SumOrder::most_works);
    ranks.broadcast(&before, sizeof before);
  }
  order.take_works(works_.data() + n_sent, works_.size() - n_sent);
  works_.clear();
  ranks.broadcast(&order, sizeof order);
}

void TeamLink::send_completing(SumOrder& order, const Sources& sources) {
  order.gathers_positions = own_positions.are(sources.position);
  order.gathers_forces = own_forces.are(sources.force);
  order.gathered_scene = order.gathers_positions ? own_positions.scene : own_forces.scene;
  post(order);
  if (order.gathers_positions) {
    gather_rows_to_all(ranks, *own_positions.owners, own_positions.rows);
    own_positions = {};
  }
  if (order.gathers_forces) {
    gather_rows_to_all(ranks, *own_forces.owners, own_forces.rows);
    own_forces = {};
  }
}

void TeamLink::complete(const Sources& sources) {
  if (!own_positions.are(sources.position) && !own_forces.are(sources.force)) return;
  SumOrder order;
  order.kind = SumOrder::Kind::work_on_parts;
  send_completing(order, sources);
}

void send_nodes(TeamLink& link, SumOrder& order, const Sources& sources, const ConstVectors& target) {
  order.n_sources = sources.position.extent_int(0);
  order.n_targets = target.extent_int(0);
  order.are_same_nodes = are_same_nodes(sources.position, target);
  if (order.n_sources > 0) {
    const BlobRange blobs = find_blob_range<ExecSpace>(ExecSpace(), sources.blob);
    order.has_one_blob = blobs.smallest == blobs.largest;
    order.blob = blobs.largest;
  }
  order.are_held = link.held.are(sources);
  link.held = {};
  link.has_divided = order.is_divided;
  if (order.is_divided && order.are_held)
    link.send(order);
  else
    link.send_completing(order, sources);
  Communicator& ranks = link.ranks;
  if (!order.are_held) {
    link.forget_positions();
    send_vectors(ranks, sources.position);
    send_vectors(ranks, sources.force);
  }
  if (!order.are_same_nodes) send_vectors(ranks, target);
  if (order.has_one_blob) return;
  const auto blob = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sources.blob);
  ranks.broadcast(const_cast<double*>(blob.data()), blob.size() * sizeof(double));
}

namespace {

template <class View>
void receive(Communicator& ranks, View& array, const int n, const char* label) {
  if (array.extent_int(0) != n) array = View(std::string(label), static_cast<std::size_t>(n));
  const auto mirror = Kokkos::create_mirror_view(array);
  ranks.broadcast(mirror.data(), mirror.size() * sizeof(double));
  Kokkos::deep_copy(array, mirror);
}

}  // namespace

void receive_vectors(Communicator& ranks, const int n, Vectors& vectors) {
  receive(ranks, vectors, n, "skein::receive_vectors");
}

void receive_nodes(Communicator& ranks, const SumOrder& order, OrderedNodes& nodes) {
  if (!order.are_held) {
    receive(ranks, nodes.position, order.n_sources, "skein::receive_nodes::position");
    receive(ranks, nodes.force, order.n_sources, "skein::receive_nodes::force");
  }
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

std::vector<Vec3> gather_sample(Communicator& ranks, const RankParts& owners, const FmmSum& sum,
                                const EvenSample& sample) {
  std::vector<std::size_t> counts(owners.count.size());
  for (int i = 0; i < sample.n_chosen; ++i) {
    const auto target = static_cast<std::size_t>(sample.index(i));
    const auto next = std::upper_bound(owners.first.begin(), owners.first.end(), target);
    counts[static_cast<std::size_t>(next - owners.first.begin()) - 1] += 3;
  }
  const RankParts parts = RankParts::behind_each_other(std::move(counts));
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  std::vector<Vec3> own = sum.sample(sample);
  std::vector<Vec3> all(own.size());
  const std::size_t first = parts.first[static_cast<std::size_t>(ranks.rank())] / 3;
  ranks.gather(&own.data()[first].x, parts, &all.data()->x);
  return all;
}

}  // namespace skein
