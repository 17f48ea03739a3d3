#pragma once

#include "fmm/passes.hpp"
#include "fmm/team_exchange.hpp"
#include "fmm/team_workers.hpp"
#include "fmm/tree_tasks.hpp"

#include <algorithm>
#include <vector>

namespace skein {

inline constexpr int team_part_targets = 128;  ///< of a leaf, that a team takes at once

/// velocity(original index) = near field + far field of the coefficients, a team for every part of a leaf; the tail of
/// the blobs is added to what is there.
template <class Space, class Near, class Real, class Field>
void sum_leaf_velocities_by_teams(const Space& space, const Passes<Space, Real, Field>& passes,
                                  const LeafParts<Space>& parts, const VectorView<Space>& velocity, int team_size);

/// Across the V lists (M2L), a run of far pairs at once; overwrites the coefficients for targets.
/// @param runs  as far.cut gives them  @param products  [those of the longest run]
template <class Space, class Real, class Field>
void transfer_by_teams(const Space& space, const Passes<Space, Real, Field>& passes, const FarOrder<Space>& far,
                       const std::vector<int>& runs, const Kokkos::View<Real*, Space>& products, int team_size);

/// How a sum goes through the execution space by teams of threads: plain kernels, for FmmEvaluator.
class TeamWorkers {
 public:
  using Space = ExecSpace;
  using Exchange = TeamExchange;
  static constexpr int part_targets = team_part_targets;
  static constexpr bool defers_counts = true;      ///< of trees, also where teams work on a host
  static constexpr bool meets_pairs_once = false;  ///< every pair is met from both sides, by direct sums, too

  /// @param team_size           threads of a team, 0: as Kokkos likes; the result does not depend on it
  /// @param most_product_bytes  room for the products of far pairs: every time that it is full, all lists are gone
  ///                            through. Sums are in another order then
  explicit TeamWorkers(const int team_size = usual_team_size<ExecSpace>,
                       const std::size_t most_product_bytes = std::size_t{1} << 29)
      : team_size_(team_size), most_product_bytes_(most_product_bytes) {}

  void take(const Space& space, Octree<Space>& tree) { far_.build(space, tree); }
  /// Where others take part: only boxes with these targets are gone to.
  void take_share(const Space& space, Octree<Space>& tree, const IndexRange own_targets) {
    far_.keep(space, tree, own_targets);
  }

  template <class Work>
  void for_boxes(const char* label, const IndexRange boxes, const Work& work) const {
    for_boxes_by_teams(Space(), label, boxes, team_size_, work);
  }

  template <class Real, class Field>
  void transfer(const Passes<Space, Real, Field>& passes, const std::vector<IndexRange>& /*boxes: all*/) const {
    const auto box_size = static_cast<std::size_t>(math::larger(1, passes.coefficients.box_size));
    const auto n_pairs = static_cast<std::size_t>(math::larger(1, far_.n_pairs));
    // Runs follow from the tree and the limit alone, so that sums have one order whatever was computed before.
    const std::size_t n = std::clamp(most_product_bytes_ / (sizeof(Real) * box_size), std::size_t{1}, n_pairs);
    const std::vector<int> runs = far_.cut(static_cast<int>(n));
    auto& products = products_of<Real>();
    require_extent(products, std::min(n, static_cast<std::size_t>(math::larger(1, far_.n_kept))) * box_size,
                   "skein::team_workers::products");
    transfer_by_teams(Space(), passes, far_, runs, products, team_size_);
  }

  template <class Near, class Real, class Field>
  void sum_leaves(const Passes<Space, Real, Field>& passes, const LeafParts<Space>& parts,
                  const VectorView<Space>& velocity) const {
    sum_leaf_velocities_by_teams<Space, Near>(Space(), passes, parts, velocity, team_size_);
  }

  double bytes() const {
    return far_.bytes() + static_cast<double>(8 * products_.size() + 4 * single_products_.size());
  }

 private:
  template <class Real>
  Kokkos::View<Real*, Space>& products_of() const {
    if constexpr (std::is_same_v<Real, double>)
      return products_;
    else
      return single_products_;
  }

  int team_size_;
  std::size_t most_product_bytes_;
  FarOrder<Space> far_;
  mutable Kokkos::View<double*, Space> products_;  ///< of far pairs, before they are added
  mutable Kokkos::View<float*, Space> single_products_;
};

}  // namespace skein
