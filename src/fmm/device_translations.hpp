#pragma once

#include "fmm/device_teams.hpp"
#include "fmm/tree_tasks.hpp"

namespace skein {

/// Coefficients of all boxes: [n_boxes][n_columns][stride].
template <class Space, class Real>
struct DeviceCoefficients {
  Kokkos::View<Real*, Space> source, target;
  Kokkos::View<Real*, Space> products;  ///< of far pairs, before they are added
  int stride = 0;                       ///< of a column: the largest padded rank of all levels
  int box_size = 0;                     ///< n_columns * stride
};

/// The passes over the boxes, as compute_coefficients on hosts: a team for every box, levels one after the other. The
/// order of every sum is that of the lists.
/// @param team_size  0: as Kokkos likes; the result does not depend on it
template <class Space, class Real, class Field>
void compute_coefficients_by_teams(const Space& space, const Octree<Space>& tree, const FarOrder<Space>& far,
                                   const DeviceNodes<Space>& nodes, const Field& field,
                                   const DeviceLevels<Space, Real>& levels,
                                   const DeviceCoefficients<Space, Real>& coefficients, int team_size);

inline constexpr int part_targets = 128;  ///< of a leaf, that a team takes at once

/// velocity(original index) = near field + far field of the coefficients, a team for every part of a leaf.
template <class Space, class Near, class Real, class Field>
void sum_leaf_velocities_by_teams(const Space& space, const Octree<Space>& tree, const LeafParts<Space>& parts,
                                  const DeviceNodes<Space>& nodes, const Field& field,
                                  const DeviceLevels<Space, Real>& levels,
                                  const DeviceCoefficients<Space, Real>& coefficients,
                                  const VectorView<Space>& velocity, int team_size);

}  // namespace skein
