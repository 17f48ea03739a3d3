#include "fmm/shared_cube.hpp"

#include "fmm/row_moves.hpp"
#include "kernels/node_checks.hpp"

#include <algorithm>
#include <span>

namespace skein {
namespace {

using Keys = std::span<const std::uint64_t>;

/// Edges between ranks, such that each gets about as many of the keys of all.
std::vector<std::uint64_t> find_edges(Communicator& ranks, const Keys own) {
  constexpr std::size_t n_told = 64;  // by each rank: keys in even steps, then how many there are
  std::vector<std::uint64_t> told(n_told);
  for (std::size_t i = 0; i < n_told && !own.empty(); ++i) told[i] = own[(2 * i + 1) * own.size() / (2 * n_told)];
  told.push_back(own.size());
  const auto n_ranks = static_cast<std::size_t>(ranks.size());
  const auto all = exchange_lists(ranks, std::vector<std::vector<std::uint64_t>>(n_ranks, told));
  struct Told {
    std::uint64_t key;
    double weight;
  };
  std::vector<Told> keys;
  double total = 0.0;
  for (const auto& of_rank : all)
    for (std::size_t i = 0; i < n_told && of_rank.back() > 0; ++i) {
      keys.push_back({of_rank[i], static_cast<double>(of_rank.back())});
      total += keys.back().weight;
    }
  std::sort(keys.begin(), keys.end(), [](const Told& a, const Told& b) { return a.key < b.key; });
  std::vector<std::uint64_t> edges;
  double before = 0.0;
  for (const Told& told_key : keys) {
    while (edges.size() + 1 < n_ranks &&
           before * static_cast<double>(n_ranks) >= total * static_cast<double>(edges.size() + 1))
      edges.push_back(told_key.key);
    before += told_key.weight;
  }
  edges.resize(n_ranks - 1, ~std::uint64_t{0});
  return edges;
}

/// Keys of all ranks, sorted, a part on each. @param sorted  own ones
std::vector<std::uint64_t> sort_among_ranks(Communicator& ranks, const Keys sorted) {
  std::vector<std::vector<std::uint64_t>> parts;
  auto next = sorted.begin();
  for (const std::uint64_t edge : find_edges(ranks, sorted)) {
    const auto last = std::lower_bound(next, sorted.end(), edge);
    parts.emplace_back(next, last);
    next = last;
  }
  parts.emplace_back(next, sorted.end());
  std::vector<std::uint64_t> own;
  for (const auto& part : exchange_lists(ranks, parts)) own.insert(own.end(), part.begin(), part.end());
  std::sort(own.begin(), own.end());
  return own;
}

/// Of all ranks' keys, of which this one has a sorted part.
void count_new_cells(Communicator& ranks, const std::vector<std::uint64_t>& own, SampledCells& cells) {
  const bool is_empty = own.empty();
  const std::vector<std::uint64_t> last = {is_empty ? 0 : own.back(), is_empty ? 0u : 1u};
  const auto all =
      exchange_lists(ranks, std::vector<std::vector<std::uint64_t>>(static_cast<std::size_t>(ranks.size()), last));
  std::vector<double> n_new(max_key_depth + 1);
  const auto count = [&](const std::uint64_t one, const std::uint64_t other) {
    if (one != other) n_new[static_cast<std::size_t>(separating_level(one, other))] += 1.0;
  };
  for (int rank = ranks.rank() - 1; rank >= 0 && !is_empty; --rank)
    if (const auto& before = all[static_cast<std::size_t>(rank)]; before[1] != 0) {
      count(own.front(), before[0]);
      break;
    }
  for (std::size_t i = 1; i < own.size(); ++i) count(own[i], own[i - 1]);
  add_up_to_all(ranks, n_new);
  for (int level = 1; level <= max_key_depth; ++level)
    cells.n_new_cells[level] = static_cast<int>(n_new[static_cast<std::size_t>(level)]);
}

}  // namespace

OctreeCube choose_shared_cube(Communicator& ranks, const ConstVectorView<HostSpace>& own, const RankParts& nodes,
                              const OctreeRules& rules, HostOctree& memory) {
  const HostSpace space;
  NodeBounds bounds = take_census<HostSpace>(space, own, own, {}).bounds;
  std::vector<double> told(bounds.low, bounds.low + 3);
  told.insert(told.end(), bounds.high, bounds.high + 3);
  const std::vector<double> all = list_from_all(ranks, told);
  for (std::size_t i = 0; i < all.size(); i += 6)
    for (std::size_t c = 0; c < 3; ++c) {
      bounds.low[c] = std::min(bounds.low[c], all[i + c]);
      bounds.high[c] = std::max(bounds.high[c], all[i + 3 + c]);
    }
  const auto sample = [&](const KeyOf& key_of, const int stride) {
    SampledCells cells;
    cells.n_keys = math::ceil_div(static_cast<int>(nodes.total()), stride);
    const auto rank = static_cast<std::size_t>(ranks.rank());
    // Of all nodes every stride-th is taken.
    const std::size_t step = static_cast<std::size_t>(stride), before = nodes.first[rank] % step;
    const std::size_t first = std::min(before == 0 ? 0 : step - before, nodes.count[rank]);
    const auto rows = Kokkos::subview(own, std::make_pair(first, nodes.count[rank]), Kokkos::ALL());
    const int n = math::ceil_div(rows.extent_int(0), stride);
    memory.sources.require(static_cast<std::size_t>(n));
    make_keys<HostSpace>(space, rows, key_of, stride, memory.sources);
    sort_by_key(space, memory.sources, n, 3 * max_key_depth, memory.sort_memory);
    count_new_cells(ranks, sort_among_ranks(ranks, {memory.sources.key.data(), static_cast<std::size_t>(n)}), cells);
    return cells;
  };
  return choose_octree_cube(bounds, static_cast<int>(nodes.total()), rules, sample);
}

}  // namespace skein
