#pragma once

#include "fmm/fmm_operator_set.hpp"
#include "fmm/laplace.hpp"
#include "fmm/octree.hpp"
#include "fmm/rank_shares.hpp"

#include <functional>
#include <vector>

namespace skein {

/// Nodes in the order of the tree.
struct SortedNodes {
  HostVectors position, force;  ///< [n_sources, 3]; forces carry the scale 1 / (8 pi viscosity)
  HostScalars blob;
  HostVectors target;  ///< [n_targets, 3]
};

/// Targets of one leaf, or some of them where it has many: one task of the near field.
struct TargetTask {
  int leaf = 0;  ///< index in HostOctree::target_leaves
  IndexRange targets;
};

inline constexpr int task_targets = 256;

/// Cuts the leaves' targets into tasks.
std::vector<TargetTask> make_target_tasks(const HostOctree& tree);

/// Coefficients of all boxes: [n_boxes][n_columns][stride].
template <class Real>
struct Coefficients {
  Kokkos::View<Real*, HostSpace> source, target;
  int stride = 0;    ///< of a column: the largest padded rank of all levels
  int box_size = 0;  ///< n_columns * stride
};

/// The passes over the boxes: from the sources up, across, and down to leaf coefficients. Sums have a fixed order,
/// every box's sum belongs to one task.
/// @param levels  the operators of each level of the tree
template <class Real, class Field>
void compute_coefficients(const HostOctree& tree, const SortedNodes& nodes, const Field& field,
                          const std::vector<const OperatorSet<Real>*>& levels, const Coefficients<Real>& coefficients);

/// One rank's part of them: up from its own sources, then what others need, by `exchange`, then across and down to its
/// own targets. Boxes that this rank has no use for stay as they are.
template <class Real, class Field>
void compute_shared_coefficients(const HostOctree& tree, const SortedNodes& nodes, const Field& field,
                                 const std::vector<const OperatorSet<Real>*>& levels,
                                 const Coefficients<Real>& coefficients, const RankShares& shares,
                                 const std::function<void()>& exchange);

/// The near field of the leaves' targets: what is there already, and what is still to be summed.
struct NearField {
  const IndexRange* runs;  ///< of sources, per target leaf runs[first[leaf]] .. runs[end[leaf] - 1]
  const int *first, *end;
  HostScalars velocity;  ///< [3][n_packed] in the packed order of NearMatches, or empty
  int n_packed = 0;
  const int* leaf_first = nullptr;  ///< per target leaf its first place in the packed order

  std::span<const IndexRange> of_leaf(const int leaf) const { return {runs + first[leaf], runs + end[leaf]}; }
};

/// velocity(original index) += near field + far field of the coefficients, leaf by leaf.
template <class Near, class Real, class Field>
void add_leaf_velocities(const HostOctree& tree, const SortedNodes& nodes, const Field& field,
                         const std::vector<const OperatorSet<Real>*>& levels, const Coefficients<Real>& coefficients,
                         const NearField& near, const std::vector<TargetTask>& tasks, const HostVectors& velocity);

}  // namespace skein
