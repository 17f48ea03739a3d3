#include "needed_rows.hpp"

#include "seen_rows.hpp"

#include <algorithm>

namespace skein {
namespace {

/// What one rank sends to each other, of rows [first, end) that each wants; what it wants of its own stays here.
/// @param behind  rows are counted from here
RankParts common_rows(const std::vector<std::size_t>& first, const std::vector<std::size_t>& end, const int rank,
                      const std::size_t own_first, const std::size_t own_end, const std::size_t behind) {
  RankParts rows;
  for (std::size_t other = 0; other < first.size(); ++other) {
    const std::size_t from = std::max(first[other], own_first), to = std::min(end[other], own_end);
    const bool has_some = to > from && other != static_cast<std::size_t>(rank);
    rows.first.push_back(has_some ? from - behind : 0);
    rows.count.push_back(has_some ? to - from : 0);
  }
  return rows;
}

}  // namespace

NeededRows find_needed_rows(const std::vector<Fiber>& fibers, const ForceList& forces, const RankParts& owners) {
  int reach = 0;
  for (const auto& force : forces) {
    const int of_force = force->promises().reach;
    if (of_force == ForcePromises::everywhere) return {};
    reach = std::max(reach, of_force);
  }
  /// The first node of the section that lies so far from a node's, or at its fiber's end.
  const auto first_of_section = [&](const std::size_t node, const int sections_on) {
    const auto fiber = std::find_if(fibers.begin(), fibers.end(), [node](const Fiber& candidate) {
      return node < static_cast<std::size_t>(candidate.first_node + candidate.n_nodes());
    });
    const int n = fiber->config.nodes_per_section, section = (static_cast<int>(node) - fiber->first_node) / n;
    return static_cast<std::size_t>(fiber->first_node +
                                    std::clamp(section + sections_on, 0, fiber->config.sections) * n);
  };
  NeededRows needed;
  for (std::size_t rank = 0; rank < owners.count.size(); ++rank) {
    const std::size_t first = owners.first[rank], end = first + owners.count[rank];
    needed.first.push_back(end > first ? first_of_section(first, -reach) : first);
    needed.end.push_back(end > first ? first_of_section(end - 1, reach + 1) : end);
  }
  return needed;
}

void gather_needed_rows(Communicator& ranks, const RankParts& owners, const NeededRows& needed, const Vectors& part,
                        const Vectors& whole, const RowAccess access) {
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const std::size_t own_first = owners.first[rank], own_end = own_first + owners.count[rank];
  Kokkos::deep_copy(ExecSpace(), rows_of(whole, own_first, owners.count[rank]), own_rows(part, owners, ranks.rank()));
  std::vector<std::size_t> end_of_owner;
  for (std::size_t other = 0; other < owners.count.size(); ++other)
    end_of_owner.push_back(owners.first[other] + owners.count[other]);
  const RankParts sent = common_rows(needed.first, needed.end, ranks.rank(), own_first, own_end, own_first);
  const std::size_t first = needed.first[rank], end = needed.end[rank];
  const RankParts received = common_rows(owners.first, end_of_owner, ranks.rank(), first, end, first);
  const bool reaches = ranks.reaches_device_memory();
  // Of the whole only the rows that are needed here, so that copies are of no others.
  const SeenRows own(part, access, reaches, 0), there(rows_of(whole, first, end - first), access, reaches, 1);
  own.look(0, owners.count[rank]);
  for (std::size_t c = 0; c < 3; ++c) ranks.exchange(own.column(c), sent, there.column(c), received);
  there.take(0, own_first - first);
  there.take(own_end - first, end - own_end);
}

}  // namespace skein
