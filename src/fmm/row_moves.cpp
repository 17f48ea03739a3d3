#include "fmm/row_moves.hpp"

#include "fmm/essential_boxes.hpp"

#include <cstring>
#include <type_traits>
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

template <class Entry>
std::vector<std::vector<Entry>> exchange_lists(Communicator& ranks, const std::vector<std::vector<Entry>>& lists) {
  static_assert(std::is_trivially_copyable_v<Entry> && sizeof(Entry) % sizeof(double) == 0);
  constexpr std::size_t width = sizeof(Entry) / sizeof(double);
  std::vector<std::size_t> n_to;
  for (const std::vector<Entry>& list : lists) n_to.push_back(list.size());
  const std::vector<std::size_t> n_from = tell_counts(ranks, n_to);
  std::vector<double> packed;
  for (const std::vector<Entry>& list : lists) {
    const std::size_t n_before = packed.size();
    packed.resize(n_before + width * list.size());
    if (!list.empty()) std::memcpy(packed.data() + n_before, list.data(), list.size() * sizeof(Entry));
  }
  const std::vector<double> received = move(ranks, packed, times(n_to, width), times(n_from, width));
  std::vector<std::vector<Entry>> there;
  const double* from = received.data();
  for (const std::size_t n : n_from) {
    there.emplace_back(n);
    if (n > 0) std::memcpy(static_cast<void*>(there.back().data()), from, n * sizeof(Entry));
    from += width * n;
  }
  return there;
}

template std::vector<std::vector<std::uint64_t>> exchange_lists(Communicator&,
                                                                const std::vector<std::vector<std::uint64_t>>&);
template std::vector<std::vector<BoxRecord>> exchange_lists(Communicator&, const std::vector<std::vector<BoxRecord>>&);
template std::vector<std::vector<IndexRange>> exchange_lists(Communicator&,
                                                             const std::vector<std::vector<IndexRange>>&);
template std::vector<std::vector<CellName>> exchange_lists(Communicator&, const std::vector<std::vector<CellName>>&);

}  // namespace skein
