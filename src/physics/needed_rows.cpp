#include "needed_rows.hpp"

#include <algorithm>
#include <utility>

namespace skein {
namespace {

/// What one rank sends to each other, of rows [first, end) that each wants; what it wants of its own stays here.
/// @param behind  rows are counted from here
RankParts common_rows(const std::vector<std::size_t>& first, const std::vector<std::size_t>& end, const int rank,
                      const std::size_t own_first, const std::size_t own_end, const std::size_t behind) {
  RankParts result;
  for (std::size_t other = 0; other < first.size(); ++other) {
    const std::size_t from = std::max(first[other], own_first), to = std::min(end[other], own_end);
    const bool has_some = to > from && other != static_cast<std::size_t>(rank);
    result.first.push_back(has_some ? from - behind : 0);
    result.count.push_back(has_some ? to - from : 0);
  }
  return result;
}

}  // namespace

NeededRows find_needed_rows(const std::vector<Fiber>& fibers, const int reach, const RankParts& owners) {
  // The first node of the section that lies so far from a node's, or at its fiber's end.
  const auto first_of_section = [&](const std::size_t of_all, const int sections_on) {
    const int node = static_cast<int>(of_all);
    const Fiber& fiber = find_fiber_of(fibers, node);
    const int n = fiber.config.nodes_per_section, section = (node - fiber.first_node) / n;
    return static_cast<std::size_t>(fiber.first_node + std::clamp(section + sections_on, 0, fiber.config.sections) * n);
  };
  NeededRows needed;
  for (std::size_t rank = 0; rank < owners.count.size(); ++rank) {
    const std::size_t first = owners.first[rank], end = first + owners.count[rank];
    needed.first.push_back(end > first ? first_of_section(first, -reach) : first);
    needed.end.push_back(end > first ? first_of_section(end - 1, reach + 1) : end);
  }
  return needed;
}

RankParts count_sections(const std::vector<Fiber>& fibers, const RankParts& owners) {
  std::vector<std::size_t> count(owners.count.size());
  std::size_t rank = 0;
  for (const Fiber& fiber : fibers)
    for (int section = 0; section < fiber.config.sections; ++section) {
      const auto node = static_cast<std::size_t>(fiber.first_node + section * fiber.config.nodes_per_section);
      while (node >= owners.first[rank] + owners.count[rank]) ++rank;
      ++count[rank];
    }
  return RankParts::behind_each_other(std::move(count));
}

RowsInTransit list_rows_in_transit(const RankParts& owners, const NeededRows& needed, const int rank) {
  const auto r = static_cast<std::size_t>(rank);
  const std::size_t own_first = owners.first[r], own_end = own_first + owners.count[r];
  std::vector<std::size_t> end_of_owner;
  for (std::size_t other = 0; other < owners.count.size(); ++other)
    end_of_owner.push_back(owners.first[other] + owners.count[other]);
  return {common_rows(needed.first, needed.end, rank, own_first, own_end, own_first),
          common_rows(owners.first, end_of_owner, rank, needed.first[r], needed.end[r], needed.first[r])};
}

}  // namespace skein
