#pragma once

#include <skein/fibers/fiber.hpp>
#include <skein/ranks/communicator.hpp>

#include <cstddef>
#include <vector>

namespace skein {

/// Of which nodes each rank needs the positions for the forces on its own: consecutive ones, and its own among them.
struct NeededRows {
  std::vector<std::size_t> first, end;  ///< [n_ranks]; empty: all nodes
  RankParts sections;                   ///< of which each rank has the nodes, where forces see centroids; else none

  bool are_all() const { return first.empty(); }
};

/// @param reach   of the forces along a fiber, sections, >= 0  @param owners  of the fibers' nodes, whole sections each
NeededRows find_needed_rows(const std::vector<Fiber>& fibers, int reach, const RankParts& owners);

/// How many sections' nodes each rank owns.
RankParts count_sections(const std::vector<Fiber>& fibers, const RankParts& owners);

/// Rows that one rank sends to each other and receives from each, where each gets what it needs of the others' own.
/// Those sent are counted from the first own row, those received from the first that is needed.
struct RowsInTransit {
  RankParts sent, received;
};
RowsInTransit list_rows_in_transit(const RankParts& owners, const NeededRows& needed, int rank);

}  // namespace skein
