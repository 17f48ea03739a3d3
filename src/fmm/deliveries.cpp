#include "fmm/deliveries.hpp"

#include <algorithm>
#include <utility>

namespace skein {

Deliveries list_deliveries(const int* order, const std::vector<int>& first_target, const RankParts& owners,
                           const int rank) {
  const std::size_t n_ranks = first_target.size() - 1, here = static_cast<std::size_t>(rank);
  Deliveries deliveries;
  std::vector<std::size_t> n_sent, n_received;
  std::vector<std::vector<int>> of_owner(n_ranks);
  for (int place = first_target[here]; place < first_target[here + 1]; ++place) {
    const auto next =
        std::upper_bound(owners.first.begin(), owners.first.end(), static_cast<std::size_t>(order[place]));
    of_owner[static_cast<std::size_t>(next - owners.first.begin()) - 1].push_back(order[place]);
  }
  const auto is_owned = [&](const int target) {
    const auto t = static_cast<std::size_t>(target);
    return t >= owners.first[here] && t < owners.first[here] + owners.count[here];
  };
  for (std::size_t other = 0; other < n_ranks; ++other) {
    deliveries.sent_targets.insert(deliveries.sent_targets.end(), of_owner[other].begin(), of_owner[other].end());
    n_sent.push_back(3 * of_owner[other].size());
    const std::size_t n_before = deliveries.received_targets.size();
    for (int place = first_target[other]; place < first_target[other + 1]; ++place)
      if (is_owned(order[place])) deliveries.received_targets.push_back(order[place]);
    n_received.push_back(3 * (deliveries.received_targets.size() - n_before));
  }
  deliveries.sent = RankParts::behind_each_other(std::move(n_sent));
  deliveries.received = RankParts::behind_each_other(std::move(n_received));
  return deliveries;
}

RankParts count_summed(const std::vector<int>& first_target) {
  std::vector<std::size_t> counts;
  for (std::size_t rank = 0; rank + 1 < first_target.size(); ++rank)
    counts.push_back(3 * static_cast<std::size_t>(first_target[rank + 1] - first_target[rank]));
  return RankParts::behind_each_other(std::move(counts));
}

}  // namespace skein
