#pragma once

#include <skein/ranks/communicator.hpp>

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

namespace skein {

/// Rows of numbers that go from each rank to others, once or again and again, and back.
class RowMoves {
 public:
  /// To be called by all ranks. @param rows  own ones that go somewhere, those for rank 0 first
  /// @param n_to  [n_ranks], how many of them go to each rank
  void agree(Communicator& ranks, std::vector<int> rows, std::vector<std::size_t> n_to);

  const std::vector<int>& rows() const { return rows_; }
  double bytes() const { return 4.0 * static_cast<double>(rows_.size()); }

  /// To be called by all ranks: numbers of `width` for each row in rows(), in that order. @returns those for each row
  /// received
  std::vector<double> send(Communicator& ranks, const std::vector<double>& numbers, std::size_t width) const;
  /// The other way, from the rows received to those that were sent.
  std::vector<double> send_back(Communicator& ranks, const std::vector<double>& numbers, std::size_t width) const;

 private:
  std::vector<int> rows_;
  std::vector<std::size_t> n_to_, n_from_;  ///< [n_ranks]
};

/// To be called by all ranks: numbers for each rank. @returns what came for this one, by rank
std::vector<std::vector<double>> exchange_lists(Communicator& ranks, const std::vector<std::vector<double>>& lists);

/// The same of other entries, which are moved as their bytes.
template <class Entry>
std::vector<std::vector<Entry>> exchange_lists(Communicator& ranks, const std::vector<std::vector<Entry>>& lists) {
  static_assert(std::is_trivially_copyable_v<Entry> && sizeof(Entry) % sizeof(double) == 0);
  constexpr std::size_t width = sizeof(Entry) / sizeof(double);
  std::vector<std::vector<double>> numbers;
  for (const std::vector<Entry>& list : lists) {
    numbers.emplace_back(width * list.size());
    if (!list.empty()) std::memcpy(numbers.back().data(), list.data(), list.size() * sizeof(Entry));
  }
  std::vector<std::vector<Entry>> there;
  for (const std::vector<double>& received : exchange_lists(ranks, numbers)) {
    there.emplace_back(received.size() / width);
    if (!received.empty())
      std::memcpy(static_cast<void*>(there.back().data()), received.data(), received.size() * sizeof(double));
  }
  return there;
}

}  // namespace skein
