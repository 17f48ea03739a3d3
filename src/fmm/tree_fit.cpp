#include "fmm/tree_fit.hpp"

namespace skein {
namespace {

/// Counts the nodes of a leaf that have left it by more than the margin.
template <class Space>
struct CountStrays {
  Kokkos::View<const Box*, Space> boxes;
  OctreeCube cube;
  TreeNodes<Space> sources, targets;

  /// Of a run's nodes, every step-th from the one at `from`.
  SKEIN_INLINE_FUNCTION int strays(const Box& box, const TreeNodes<Space>& nodes, const IndexRange run, const int from,
                                   const int step) const {
    const Vec3 center = cube.center(box);
    const double origin[3] = {center.x, center.y, center.z};
    const double reach = (1.0 + leaf_margin) * cube.half_width(box.level);
    int n = 0;
    for (int i = run.first + from; i < run.first + run.count; i += step) {
      const int node = nodes.order(i);
      bool is_near = true;
      for (int c = 0; c < 3; ++c) {
        const double away = nodes.position(node, c) - origin[c];
        is_near = is_near && away <= reach && away >= -reach;  // false for what is not a number
      }
      n += is_near ? 0 : 1;
    }
    return n;
  }

  SKEIN_INLINE_FUNCTION int strays(const int b, const int from, const int step) const {
    const Box& box = boxes(b);
    if (!box.is_leaf()) return 0;
    return strays(box, sources, box.sources, from, step) +
           (targets.order.extent(0) > 0 ? strays(box, targets, box.targets, from, step) : 0);
  }

  SKEIN_INLINE_FUNCTION void operator()(const int b, int& n_strays) const { n_strays += strays(b, 0, 1); }
};

/// The same, a box to a team.
template <class Space>
struct CountStraysByTeams {
  CountStrays<Space> count;
  SKEIN_INLINE_FUNCTION void operator()(const typename Kokkos::TeamPolicy<Space>::member_type& team,
                                        int& n_strays) const {
    n_strays += count.strays(team.league_rank(), team.team_rank(), team.team_size());
  }
};

}  // namespace

template <class Space>
void seek_strays(const Space& space, const Kokkos::View<const Box*, Space>& boxes, const OctreeCube& cube,
                 const TreeNodes<Space>& sources, const TreeNodes<Space>& targets, const FoundNumber& n_strays) {
  const CountStrays<Space> count{boxes, cube, sources, targets};
  const Kokkos::Sum<int, SharedHostMemory> sum(n_strays);
  const int n_boxes = boxes.extent_int(0);
  if constexpr (on_host<Space>)
    Kokkos::parallel_reduce("skein::seek_strays", Kokkos::RangePolicy<Space>(space, 0, n_boxes), count, sum);
  else
    Kokkos::parallel_reduce("skein::seek_strays", Kokkos::TeamPolicy<Space>(space, n_boxes, 128),
                            CountStraysByTeams<Space>{count}, sum);
}

#define SKEIN_INSTANTIATE(S)                                                                                         \
  template void seek_strays<S>(const S&, const Kokkos::View<const Box*, S>&, const OctreeCube&, const TreeNodes<S>&, \
                               const TreeNodes<S>&, const FoundNumber&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
