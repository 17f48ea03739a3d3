#include "fmm/octree_walk.hpp"

#include <algorithm>

// The interaction lists of a tree, and what is counted with them.

namespace skein {
namespace {

/// After a wait. False where lists found no room, which there is now.
template <class Space>
bool take_totals(Octree<Space>& tree) {
  const FoundTotals& totals = tree.totals;
  tree.n_target_leaves = totals.n_target_leaves();
  tree.largest_leaf = tree.n_target_leaves > 0 ? tree.half_width(totals.coarsest_leaf()) : 0.0;
  tree.n_near_pairs = static_cast<double>(totals.near_pairs());
  tree.transfers = totals.transfers();
  const FoundNumbers& n = totals.entries;
  const bool had_room[] = {take_room(tree.v_list, n(FoundTotals::v)), take_room(tree.x_list, n(FoundTotals::x)),
                           take_room(tree.x_direct, n(FoundTotals::x_direct)),
                           take_room(tree.u_list, n(FoundTotals::u)), take_room(tree.w_list, n(FoundTotals::w))};
  return std::find(std::begin(had_room), std::end(had_room), false) == std::end(had_room);
}

}  // namespace

template <class Space>
void build_lists(const Space& space, Octree<Space>& tree) {
  do {
    build_far_lists(space, tree);
    build_near_lists(space, tree);
    wait_for(space);
  } while (!take_totals(tree));
}

#define SKEIN_INSTANTIATE(S) template void build_lists<S>(const S&, Octree<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
