#include "fmm/fmm_evaluator.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

// What ranks that share a sum tell each other.

namespace skein {

void FmmEvaluator::require_shares(const FmmPlan& plan) {
  if (has_shares_) return;
  shares_ = share_tree(tree_, plan, is_symmetric_, ranks_->rank(), ranks_->size());
  has_shares_ = true;
  drop_far_pairs_but(shares_.target_boxes, tree_);
  const auto is_foreign = [&](const TargetTask& task) { return !shares_.has_target(task.targets.first); };
  tasks_.erase(std::remove_if(tasks_.begin(), tasks_.end(), is_foreign), tasks_.end());
}

template <class Real>
void FmmEvaluator::exchange(const Coefficients<Real>& coefficients) {
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

void FmmEvaluator::gather_velocities() {
  std::vector<std::size_t> counts;
  for (std::size_t rank = 0; rank + 1 < shares_.first_target.size(); ++rank)
    counts.push_back(3 * static_cast<std::size_t>(shares_.first_target[rank + 1] - shares_.first_target[rank]));
  const RankParts parts = RankParts::behind_each_other(std::move(counts));
  const IndexRange own = shares_.own_targets();
  const auto order = tree_.target_order();
  send_.resize(3 * static_cast<std::size_t>(own.count));
  for (int i = 0; i < own.count; ++i)
    for (int c = 0; c < 3; ++c) send_[static_cast<std::size_t>(3 * i + c)] = own_velocity_(order(own.first + i), c);
  if (ranks_->rank() == 0) receive_.resize(parts.total());
  ranks_->gather(send_.data(), parts, receive_.data());
  if (ranks_->rank() != 0) return;
  for (int i = own.first + own.count; i < tree_.n_targets; ++i)
    for (int c = 0; c < 3; ++c)
      own_velocity_(order(i), c) = receive_[3 * static_cast<std::size_t>(i) + static_cast<std::size_t>(c)];
}

template void FmmEvaluator::exchange(const Coefficients<double>&);
template void FmmEvaluator::exchange(const Coefficients<float>&);

}  // namespace skein
