#include "fmm/rank_exchange.hpp"

// What ranks tell each other where each has a part of the tree.

namespace skein {

void RankExchange::make_part(Communicator& ranks, const RankParts& given, const OctreeRules& rules, HostOctree& tree,
                             const UnsortedNodes<HostSpace>& own, const double one_blob, const double scale,
                             SortedNodes<HostSpace>& nodes) {
  ranks_ = &ranks;
  part_.build(ranks, own.position, given, rules, tree);
  part_.move_nodes(ranks, tree, own, one_blob, scale, nodes);
}

bool RankExchange::keeps_part(const HostOctree& tree, const UnsortedNodes<HostSpace>& own, const double one_blob,
                              const double scale, SortedNodes<HostSpace>& nodes) {
  part_.move_nodes(*ranks_, tree, own, one_blob, scale, nodes);
  return part_.still_fits(*ranks_, tree, nodes);
}

void RankExchange::share_part(HostOctree& tree, const FmmPlan& plan, const bool is_symmetric) {
  shares_ = part_.make_shares(*ranks_, tree, plan, is_symmetric);
}

void RankExchange::return_velocities(const RankParts& given, const bool to_rank_0, const HostVectors& velocity) {
  const auto rank = static_cast<std::size_t>(ranks_->rank());
  const std::size_t n_rows = to_rank_0 && rank == 0 ? given.total() : given.count[rank];
  if (velocity_.extent(0) != n_rows) velocity_ = HostVectors("skein::RankExchange::velocity", n_rows);
  part_.return_velocities(*ranks_, velocity, velocity_);
  if (!to_rank_0) return;
  // The first rows of all are rank 0's own.
  for (std::size_t c = 0; c < 3; ++c) {
    double* const column = velocity_.data() + c * velocity_.stride(1);
    send_.assign(column, column + given.count[rank]);
    ranks_->gather(send_.data(), given, column);
  }
}

void RankExchange::count_whole(const RankParts& given, FmmStatistics& statistics) const {
  const EssentialTree::Totals& whole = part_.totals();
  const auto n_nodes = static_cast<double>(given.total());
  statistics.n_boxes = whole.n_boxes;
  statistics.n_leaves = whole.n_leaves;
  statistics.work = {n_nodes, n_nodes, whole.near_pairs, whole.far_pairs, static_cast<double>(whole.n_boxes)};
}

}  // namespace skein
