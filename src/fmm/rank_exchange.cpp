#include "fmm/rank_exchange.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace skein {

void RankExchange::share(Communicator& ranks, HostOctree& tree, const FmmPlan& plan, const bool is_symmetric) {
  ranks_ = &ranks;
  shares_ = share_tree(tree, plan, is_symmetric, ranks.rank(), ranks.size());
  drop_far_pairs_but(shares_.target_boxes, tree);
  n_sent_.clear();
}

template <class Real>
void RankExchange::exchange_coefficients(const Coefficients<HostSpace, Real>& coefficients) {
  const std::size_t n_bytes = static_cast<std::size_t>(coefficients.box_size) * sizeof(Real);
  const std::size_t n_doubles = n_bytes / sizeof(double);
  const auto count = [&](const std::vector<std::vector<int>>& boxes) {
    std::vector<std::size_t> counts;
    for (const std::vector<int>& of_rank : boxes) counts.push_back(of_rank.size() * n_doubles);
    return RankParts::behind_each_other(std::move(counts));
  };
  const RankParts sent = count(shares_.sent), received = count(shares_.received);
  send_.resize(sent.total());
  receive_.resize(received.total());
  const auto place_of = [&](const int box) {
    return coefficients.source.data() + static_cast<std::ptrdiff_t>(box) * coefficients.box_size;
  };
  double* to = send_.data();
  for (const std::vector<int>& boxes : shares_.sent)
    for (const int box : boxes) {
      std::memcpy(to, place_of(box), n_bytes);
      to += n_doubles;
    }
  ranks_->exchange(send_.data(), sent, receive_.data(), received);
  const double* from = receive_.data();
  for (const std::vector<int>& boxes : shares_.received)
    for (const int box : boxes) {
      std::memcpy(place_of(box), from, n_bytes);
      from += n_doubles;
    }
}

void RankExchange::gather_velocities(const HostOctree& tree, const HostVectors& velocity) {
  std::vector<std::size_t> counts;
  for (std::size_t rank = 0; rank + 1 < shares_.first_target.size(); ++rank)
    counts.push_back(3 * static_cast<std::size_t>(shares_.first_target[rank + 1] - shares_.first_target[rank]));
  const RankParts parts = RankParts::behind_each_other(std::move(counts));
  const IndexRange own = shares_.own_targets();
  const auto order = tree.target_order();
  send_.resize(3 * static_cast<std::size_t>(own.count));
  for (int i = 0; i < own.count; ++i)
    for (int c = 0; c < 3; ++c) send_[static_cast<std::size_t>(3 * i + c)] = velocity(order(own.first + i), c);
  if (ranks_->rank() == 0) receive_.resize(parts.total());
  ranks_->gather(send_.data(), parts, receive_.data());
  if (ranks_->rank() != 0) return;
  for (int i = own.first + own.count; i < tree.n_targets; ++i)
    for (int c = 0; c < 3; ++c)
      velocity(order(i), c) = receive_[3 * static_cast<std::size_t>(i) + static_cast<std::size_t>(c)];
}

void RankExchange::list_deliveries(const HostOctree& tree, const RankParts& owners) {
  const auto order = tree.target_order();
  const auto n_ranks = static_cast<std::size_t>(shares_.n_ranks);
  const auto owned = [&](const int target, const std::size_t rank) {
    const auto t = static_cast<std::size_t>(target);
    return t >= owners.first[rank] && t < owners.first[rank] + owners.count[rank];
  };
  const IndexRange own = shares_.own_targets();
  sent_targets_.clear();
  received_targets_.clear();
  n_sent_.clear();
  n_received_.clear();
  listed_for_ = owners.count;
  std::vector<std::vector<int>> of_owner(n_ranks);
  for (int place = own.first; place < own.first + own.count; ++place) {
    const auto next =
        std::upper_bound(owners.first.begin(), owners.first.end(), static_cast<std::size_t>(order(place)));
    of_owner[static_cast<std::size_t>(next - owners.first.begin()) - 1].push_back(order(place));
  }
  for (std::size_t rank = 0; rank < n_ranks; ++rank) {
    sent_targets_.insert(sent_targets_.end(), of_owner[rank].begin(), of_owner[rank].end());
    n_sent_.push_back(3 * of_owner[rank].size());
    const std::size_t n_before = received_targets_.size();
    for (int place = shares_.first_target[rank]; place < shares_.first_target[rank + 1]; ++place)
      if (owned(order(place), static_cast<std::size_t>(shares_.rank))) received_targets_.push_back(order(place));
    n_received_.push_back(3 * (received_targets_.size() - n_before));
  }
}

void RankExchange::deliver_velocities(const HostOctree& tree, const RankParts& owners, const HostVectors& velocity) {
  if (n_sent_.empty() || listed_for_ != owners.count) list_deliveries(tree, owners);
  const RankParts sent = RankParts::behind_each_other(n_sent_), received = RankParts::behind_each_other(n_received_);
  send_.clear();
  receive_.resize(received.total());
  for (const int target : sent_targets_)
    for (int c = 0; c < 3; ++c) send_.push_back(velocity(target, c));
  ranks_->exchange(send_.data(), sent, receive_.data(), received);
  const double* number = receive_.data();
  for (const int target : received_targets_)
    for (int c = 0; c < 3; ++c) velocity(target, c) = *number++;
}

template void RankExchange::exchange_coefficients(const Coefficients<HostSpace, double>&);
template void RankExchange::exchange_coefficients(const Coefficients<HostSpace, float>&);

}  // namespace skein
