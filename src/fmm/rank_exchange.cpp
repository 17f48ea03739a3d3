#include "fmm/rank_exchange.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace skein {

void RankExchange::share(Communicator& ranks, HostOctree& tree, const FmmPlan& plan, const bool is_symmetric) {
  ranks_ = &ranks;
  shares_ = share_tree(tree, plan, is_symmetric, ranks.rank(), ranks.size());
  drop_far_pairs_but(shares_.target_boxes, tree);
  listed_for_.clear();
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
  const RankParts parts = count_summed(shares_.first_target);
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

void RankExchange::deliver_velocities(const HostOctree& tree, const RankParts& owners, const HostVectors& velocity) {
  if (listed_for_ != owners.count) {
    deliveries_ = list_deliveries(tree.target_order().data(), shares_.first_target, owners, shares_.rank);
    listed_for_ = owners.count;
  }
  send_.clear();
  receive_.resize(deliveries_.received.total());
  for (const int target : deliveries_.sent_targets)
    for (int c = 0; c < 3; ++c) send_.push_back(velocity(target, c));
  ranks_->exchange(send_.data(), deliveries_.sent, receive_.data(), deliveries_.received);
  const double* number = receive_.data();
  for (const int target : deliveries_.received_targets)
    for (int c = 0; c < 3; ++c) velocity(target, c) = *number++;
}

template void RankExchange::exchange_coefficients(const Coefficients<HostSpace, double>&);
template void RankExchange::exchange_coefficients(const Coefficients<HostSpace, float>&);

}  // namespace skein
