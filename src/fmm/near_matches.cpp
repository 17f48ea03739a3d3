#include "fmm/near_matches.hpp"

#include "fmm/octree_walk.hpp"
#include "kernels/stokeslet_exchange.hpp"

#include <algorithm>
#include <cstdint>

namespace skein {
namespace {

/// Of a leaf's tiles but the last: even parts of whole packs.
int tile_size(const int n_nodes) {
  const int n_tiles = math::ceil_div(n_nodes, side_nodes);
  return math::ceil_div(n_nodes, n_tiles * tile_step) * tile_step;
}

void cut_leaf(const IndexRange nodes, std::vector<IndexRange>& tiles) {
  const int size = tile_size(nodes.count);
  for (int i = 0; i < nodes.count; i += size) tiles.push_back({nodes.first + i, math::smaller(size, nodes.count - i)});
}

/// Matches of equal distance d = other - one whose first tiles lie in the same half of a period of 2 d have no tile in
/// common, so that threads seldom wait for each other. @param one_tile, other_tile  numbers among those of the whole
/// tree
std::uint64_t place_of(const int one_tile, const int other_tile) {
  const auto distance = static_cast<std::uint64_t>(other_tile - one_tile);
  const auto one = static_cast<std::uint64_t>(one_tile);
  const std::uint64_t half = distance == 0 ? 0 : one / distance % 2;
  return (2 * distance + half) << 31 | one;
}

/// Leaves that do not touch meet across W and X lists, where both are leaves in both directions or in none: a small box
/// that is not a leaf gets an expansion from those it sends sources to.
struct PartnerSinks {
  int leaf = 0;
  EntrySink<int> partners;  ///< from itself on, and those of other ranks
  EntrySink<IndexRange> one_way;
  void near(const int b, const Box& box) {
    if (!box.is_leaf())
      one_way.add(box.sources);
    else if (b >= leaf || box.targets.count == 0)
      partners.add(b);
  }
  void fine(int /*b*/) const {}
};

template <class Entry>
void place(Lists<Entry, HostSpace>& lists, const int n, const char* label) {
  lists.n_entries = scan_counts(HostSpace(), lists.first, n);
  require_extent(lists.entries, static_cast<std::size_t>(lists.n_entries), label);
}

/// Per target leaf the boxes that are leaves and exchange velocities with it, and what it only receives.
void list_partners(const HostOctree& tree, Lists<int, HostSpace>& partners, Lists<IndexRange, HostSpace>& one_way) {
  const int n_leaves = tree.n_target_leaves;
  require_extent(partners.first, static_cast<std::size_t>(n_leaves) + 1, "skein::near_matches::partners_first");
  require_extent(one_way.first, static_cast<std::size_t>(n_leaves) + 1, "skein::near_matches::one_way_first");
  const ListSource<HostSpace> from(tree);
  for (const bool fills : {false, true}) {
    Kokkos::parallel_for("skein::list_partners", Kokkos::RangePolicy<HostSpace>(HostSpace(), 0, n_leaves),
                         [&](const int leaf) {
                           PartnerSinks sinks{tree.target_leaves(leaf), {}, {}};
                           if (fills) {
                             sinks.partners.to = partners.entries.data() + partners.first(leaf);
                             sinks.one_way.to = one_way.entries.data() + one_way.first(leaf);
                           }
                           visit_near(from, sinks.leaf, tree.rules.min_sources_for_expansion, sinks);
                           if (fills) return;
                           partners.first(leaf) = sinks.partners.n;
                           one_way.first(leaf) = sinks.one_way.n;
                         });
    if (fills) continue;
    place(partners, n_leaves, "skein::near_matches::partners");
    place(one_way, n_leaves, "skein::near_matches::one_way");
  }
}

/// Leaves with tiles: those with targets, and those of other ranks that meet them.
std::vector<int> list_leaves(const HostOctree& tree, const Lists<int, HostSpace>& partners) {
  std::vector<int> leaves(tree.target_leaves.data(), tree.target_leaves.data() + tree.n_target_leaves);
  for (int k = 0; k < partners.n_entries; ++k)
    if (tree.box(partners.entries(k)).targets.count == 0) leaves.push_back(partners.entries(k));
  if (leaves.size() == static_cast<std::size_t>(tree.n_target_leaves)) return leaves;
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  return leaves;
}

}  // namespace

int count_tiles(const int n_nodes) { return n_nodes == 0 ? 0 : math::ceil_div(n_nodes, tile_size(n_nodes)); }

NearMatches make_near_matches(const HostOctree& tree, const RankShares* shares, const std::vector<int>* first_number) {
  NearMatches near;
  const int n_leaves = tree.n_target_leaves;
  Lists<int, HostSpace> partners;
  list_partners(tree, partners, near.one_way);
  std::vector<int> place_of_box(static_cast<std::size_t>(tree.n_boxes()));  // among the leaves with tiles
  std::vector<int> first_tile, number;                                      // the latter empty: tiles' own places
  for (const int box : list_leaves(tree, partners)) {
    place_of_box[static_cast<std::size_t>(box)] = static_cast<int>(first_tile.size());
    first_tile.push_back(static_cast<int>(near.tiles.size()));
    cut_leaf(tree.box(box).sources, near.tiles);
    if (first_number == nullptr) continue;
    for (int next = (*first_number)[static_cast<std::size_t>(box)]; number.size() < near.tiles.size(); ++next)
      number.push_back(next);
  }
  first_tile.push_back(static_cast<int>(near.tiles.size()));
  const auto tiles_of = [&](const int box) {
    const auto i = static_cast<std::size_t>(place_of_box[static_cast<std::size_t>(box)]);
    return IndexRange{first_tile[i], first_tile[i + 1] - first_tile[i]};
  };
  const auto is_own = [&](const int tile) {
    return shares == nullptr || shares->has_target(near.tiles[static_cast<std::size_t>(tile)].first);
  };
  for (int leaf = 0; leaf < n_leaves; ++leaf) {
    const int box = tree.target_leaves(leaf);
    for (const int partner : partners.of(leaf)) {
      const IndexRange own = tiles_of(math::smaller(box, partner)), others = tiles_of(math::larger(box, partner));
      if (!is_own(own.first) && !is_own(others.first)) continue;
      for (int i = own.first; i < own.first + own.count; ++i)
        for (int j = partner == box ? i : others.first; j < others.first + others.count; ++j)
          near.matches.push_back({i, j});
    }
  }
  const auto number_of = [&](const int tile) { return number.empty() ? tile : number[static_cast<std::size_t>(tile)]; };
  const auto place = [&](const Match& match) { return place_of(number_of(match.one), number_of(match.other)); };
  std::sort(near.matches.begin(), near.matches.end(),
            [&](const Match& a, const Match& b) { return place(a) < place(b); });
  count_turns(static_cast<int>(near.tiles.size()), near.matches);
  std::vector<char> is_met(near.tiles.size());
  for (const Match& match : near.matches)
    is_met[static_cast<std::size_t>(match.one)] = is_met[static_cast<std::size_t>(match.other)] = 1;
  near.packed_first.push_back(0);
  for (std::size_t tile = 0; tile < is_met.size(); ++tile) {
    if (is_met[tile] != 0) near.met.push_back(static_cast<int>(tile));
    const int n_places = math::ceil_div(near.tiles[tile].count, tile_step) * tile_step;
    near.packed_first.push_back(near.n_packed() + (is_met[tile] != 0 ? n_places : 0));
  }
  for (int leaf = 0; leaf < n_leaves; ++leaf)
    near.leaf_first.push_back(near.packed_first[static_cast<std::size_t>(tiles_of(tree.target_leaves(leaf)).first)]);
  return near;
}

}  // namespace skein
