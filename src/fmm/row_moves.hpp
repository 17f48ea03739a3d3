#pragma once

#include <skein/ranks/communicator.hpp>

#include <cstddef>
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

/// To be called by all ranks: entries for each rank, packed behind each other. @returns what came for this one, by rank
template <class Entry>
std::vector<std::vector<Entry>> exchange_lists(Communicator& ranks, const std::vector<std::vector<Entry>>& lists);

}  // namespace skein
