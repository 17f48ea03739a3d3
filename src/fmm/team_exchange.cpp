#include "fmm/team_exchange.hpp"

#include <skein/fmm/fmm_cost.hpp>

#include "fmm/tree_tasks.hpp"

#include <algorithm>
#include <utility>

namespace skein {
namespace {

/// The first entries of an array, where the host reaches them.
template <class View>
auto copy_to_host(const View& array, const int n) {
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), Kokkos::subview(array, std::make_pair(0, n)));
}

Kokkos::View<const int*, ExecSpace> copy_to_device(const std::vector<int>& list) {
  const Kokkos::View<int*, ExecSpace> there("skein::team_exchange::targets", list.size());
  const auto on_host = Kokkos::create_mirror_view(there);
  std::copy(list.begin(), list.end(), on_host.data());
  Kokkos::deep_copy(there, on_host);
  return there;
}

}  // namespace

RankShares share_targets(const Octree<ExecSpace>& tree, const FmmPlan& plan, const int rank, const int n_ranks) {
  const int n_leaves = tree.n_target_leaves;
  const Scalars near_pairs("skein::team_exchange::near_pairs", static_cast<std::size_t>(n_leaves));
  count_near_pairs<ExecSpace>(ExecSpace(), tree, near_pairs);
  const auto of_leaf = copy_to_host(near_pairs, n_leaves);
  const auto leaves = copy_to_host(tree.target_leaves, n_leaves);
  const auto boxes = copy_to_host(tree.boxes, tree.n_boxes());
  const auto first_pair = copy_to_host(tree.v_list.first, tree.n_boxes() + 1);

  std::vector<double> near(static_cast<std::size_t>(tree.n_boxes()));
  for (int leaf = 0; leaf < n_leaves; ++leaf) near[static_cast<std::size_t>(leaves(leaf))] = of_leaf(leaf);
  std::vector<WorkPiece> pieces;
  for (int b = 0; b < tree.n_boxes(); ++b) {
    const Box& box = boxes(b);
    if (box.targets.count == 0) continue;
    FmmWork work;
    work.n_targets = box.is_leaf() ? box.targets.count : 0;
    work.near_pairs = near[static_cast<std::size_t>(b)];
    work.far_pairs = first_pair(b + 1) - first_pair(b);
    work.n_boxes = 1.0;
    pieces.push_back({box.targets.first, estimate_nanoseconds(work, plan, false, KernelPath::device), box.is_leaf()});
  }
  RankShares shares;
  shares.rank = rank;
  shares.n_ranks = n_ranks;
  shares.first_target = cut_work(pieces, tree.n_targets, n_ranks, shares.balance);
  shares.source_runs = {{0, tree.n_sources}};
  shares.n_boxes = 2.0 * tree.n_boxes();
  const IndexRange own = shares.own_targets();
  for (int level = 0; level < tree.n_levels(); ++level) {
    const IndexRange all = tree.level(level);
    IndexRange own_boxes;
    for (int b = all.first; b < all.first + all.count; ++b)
      if (overlap(boxes(b).targets, own)) widen(own_boxes, b);
    shares.source_boxes.push_back(all);
    shares.target_boxes.push_back(own_boxes);
  }
  return shares;
}

void TeamExchange::share(Communicator& ranks, const Octree<ExecSpace>& tree, const FmmPlan& plan, bool) {
  ranks_ = &ranks;
  shares_ = share_targets(tree, plan, ranks.rank(), ranks.size());
  listed_for_.clear();
}

void TeamExchange::Staged::require(const std::size_t n) {
  if (here.extent(0) >= n) return;
  here = Scalars("skein::team_exchange::numbers", n + n / 8);
  on_host = Kokkos::create_mirror_view(here);
}

void TeamExchange::pack(const Vectors& velocity, const Targets& targets) {
  const std::size_t n = 3 * targets.extent(0);
  send_.require(n);
  pack_vectors<ExecSpace>(ExecSpace(), velocity, targets, send_.here);
  Kokkos::deep_copy(Kokkos::subview(send_.on_host, std::make_pair(std::size_t{0}, n)), send_.first(n));
}

void TeamExchange::unpack(const std::size_t first_number, const Targets& targets, const Vectors& velocity) {
  const auto numbers = std::make_pair(first_number, first_number + 3 * targets.extent(0));
  const Scalars received = Kokkos::subview(receive_.here, numbers);
  Kokkos::deep_copy(received, Kokkos::subview(receive_.on_host, numbers));
  unpack_vectors<ExecSpace>(ExecSpace(), received, targets, velocity);
}

void TeamExchange::gather_velocities(const Octree<ExecSpace>& tree, const Vectors& velocity) {
  if (ranks_->size() == 1) return;
  const RankParts parts = count_summed(shares_.first_target);
  const IndexRange own = shares_.own_targets();
  const Targets order = tree.target_order();
  pack(velocity, Kokkos::subview(order, std::make_pair(own.first, own.first + own.count)));
  if (ranks_->rank() == 0) receive_.require(parts.total());
  ranks_->gather(send_.on_host.data(), parts, receive_.on_host.data());
  if (ranks_->rank() == 0)
    unpack(3 * static_cast<std::size_t>(own.count), Kokkos::subview(order, std::make_pair(own.count, tree.n_targets)),
           velocity);
}

void TeamExchange::list_targets(const Octree<ExecSpace>& tree, const RankParts& owners) {
  const auto order = copy_to_host(tree.target_order(), tree.n_targets);
  deliveries_ = list_deliveries(order.data(), shares_.first_target, owners, shares_.rank);
  sent_targets_ = copy_to_device(deliveries_.sent_targets);
  received_targets_ = copy_to_device(deliveries_.received_targets);
  listed_for_ = owners.count;
}

void TeamExchange::deliver_velocities(const Octree<ExecSpace>& tree, const RankParts& owners, const Vectors& velocity) {
  if (listed_for_ != owners.count) list_targets(tree, owners);
  pack(velocity, sent_targets_);
  receive_.require(deliveries_.received.total());
  ranks_->exchange(send_.on_host.data(), deliveries_.sent, receive_.on_host.data(), deliveries_.received);
  unpack(0, received_targets_, velocity);
}

}  // namespace skein
