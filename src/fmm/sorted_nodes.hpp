#pragma once

#include "fmm/octree.hpp"

namespace skein {

/// Nodes in the order of the tree, in a space's memory; arrays may be longer than what is in use.
template <class Space>
struct SortedNodes {
  VectorView<Space> position, force;  ///< [n_sources, 3]; forces carry the scale 1 / (8 pi viscosity)
  ScalarView<Space> blob;
  VectorView<Space> target;  ///< [n_targets, 3]; `position` itself where the sources are the targets

  double bytes() const;
};

/// Sources and targets in the order of the caller.
template <class Space>
struct UnsortedNodes {
  ConstVectorView<Space> position, force, target;
  ConstScalarView<Space> blob;
};

/// Arrays that hold what the tree has.
template <class Space>
void require_nodes(const Octree<Space>& tree, SortedNodes<Space>& sorted);

/// @param sources, targets  places in the tree's order that are wanted; others keep what they have
template <class Space>
void sort_nodes(const Space& space, const Octree<Space>& tree, const UnsortedNodes<Space>& nodes, double scale,
                IndexRange sources, IndexRange targets, const SortedNodes<Space>& sorted);

/// packed(3 i + c) = component c of vector list(i), and back.
template <class Space>
void pack_vectors(const Space& space, const ConstVectorView<Space>& vectors,
                  const Kokkos::View<const int*, Space>& list, const ScalarView<Space>& packed);
template <class Space>
void unpack_vectors(const Space& space, const ConstScalarView<Space>& packed,
                    const Kokkos::View<const int*, Space>& list, const VectorView<Space>& vectors);

}  // namespace skein
