#pragma once

#include <skein/fibers/fiber.hpp>
#include <skein/ranks/communicator.hpp>

#include "force_table.hpp"
#include "node_parts.hpp"

#include <cstddef>
#include <vector>

namespace skein {

/// Of which nodes each rank needs the positions for the forces on its own: consecutive ones, and its own among them.
struct NeededRows {
  std::vector<std::size_t> first, end;  ///< [n_ranks]; empty: all nodes

  bool are_all() const { return first.empty(); }
};

/// By what the forces promise of their reach. @param owners  of the fibers' nodes, whole sections each
NeededRows find_needed_rows(const std::vector<Fiber>& fibers, const ForceList& forces, const RankParts& owners);

/// To be called by all ranks: of an array on nodes, the rows that each needs, its own included.
/// @param needed  not all  @param part  own rows  @param whole  [owners.total(), 3], of which other rows stay as they
/// are
void gather_needed_rows(Communicator& ranks, const RankParts& owners, const NeededRows& needed, const Vectors& part,
                        const Vectors& whole, RowAccess access = RowAccess::as_needed);

}  // namespace skein
