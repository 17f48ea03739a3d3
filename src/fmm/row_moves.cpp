#include "fmm/row_moves.hpp"

#include <utility>

namespace skein {
namespace {

std::vector<std::size_t> times(const std::vector<std::size_t>& counts, const std::size_t width) {
  std::vector<std::size_t> product;
  for (const std::size_t count : counts) product.push_back(width * count);
  return product;
}

std::vector<double> move(Communicator& ranks, const std::vector<double>& numbers, std::vector<std::size_t> n_to,
                         std::vector<std::size_t> n_from) {
  const RankParts sent = RankParts::behind_each_other(std::move(n_to));
  const RankParts received = RankParts::behind_each_other(std::move(n_from));
  std::vector<double> there(received.total());
  ranks.exchange(numbers.data(), sent, there.data(), received);
  return there;
}

/// How much comes from each rank, of those that know how much they send to each.
std::vector<std::size_t> tell_counts(Communicator& ranks, const std::vector<std::size_t>& n_to) {
  const std::vector<double> send(n_to.begin(), n_to.end());
  std::vector<double> receive(send.size());
  const RankParts one_each = RankParts::behind_each_other(std::vector<std::size_t>(send.size(), 1));
  ranks.exchange(send.data(), one_each, receive.data(), one_each);
  return {receive.begin(), receive.end()};
}

}  // namespace

void RowMoves::agree(Communicator& ranks, std::vector<int> rows, std::vector<std::size_t> n_to) {
  rows_ = std::move(rows);
  n_to_ = std::move(n_to);
  n_from_ = tell_counts(ranks, n_to_);
}

std::vector<double> RowMoves::send(Communicator& ranks, const std::vector<double>& numbers,
                                   const std::size_t width) const {
  return move(ranks, numbers, times(n_to_, width), times(n_from_, width));
}

std::vector<double> RowMoves::send_back(Communicator& ranks, const std::vector<double>& numbers,
                                        const std::size_t width) const {
  return move(ranks, numbers, times(n_from_, width), times(n_to_, width));
}

std::vector<std::vector<double>> exchange_lists(Communicator& ranks, const std::vector<std::vector<double>>& lists) {
  std::vector<std::size_t> n_to;
  std::vector<double> packed;
  for (const std::vector<double>& list : lists) {
    n_to.push_back(list.size());
    packed.insert(packed.end(), list.begin(), list.end());
  }
  const std::vector<std::size_t> n_from = tell_counts(ranks, n_to);
  const std::vector<double> received = move(ranks, packed, std::move(n_to), n_from);
  std::vector<std::vector<double>> there;
  auto next = received.begin();
  for (const std::size_t n : n_from) {
    there.emplace_back(next, next + static_cast<std::ptrdiff_t>(n));
    next += static_cast<std::ptrdiff_t>(n);
  }
  return there;
}

}  // namespace skein
