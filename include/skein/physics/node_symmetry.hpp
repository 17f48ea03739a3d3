#pragma once

#include <skein/arrays/types.hpp>
#include <skein/fibers/node_orbits.hpp>

namespace skein {

/// A group as kernels take it.
struct SignGroup {
  static constexpr int most_elements = 8;  ///< there are no more matrices of signs
  SignMatrix element[most_elements];
  int n_elements = 0;
};

/// Orbits of nodes on the device: what takes vectors from first nodes to their images. One thread writes all nodes of
/// an orbit, so that results do not depend on the number of threads.
class NodeSymmetry {
 public:
  explicit NodeSymmetry(NodeOrbits orbits);

  const NodeOrbits& orbits() const { return orbits_; }

  /// Makes vectors symmetric to the last bit, by those of first nodes: what rounding and sums in other orders did to
  /// the others is gone. @param vectors  [n_nodes, 3]
  void project(const Vectors& vectors) const;

  /// The first nodes' vectors, without components that are zero by symmetry.
  /// @param of_node   [n_nodes, 3]  @param of_orbit  [n_orbits, 3], overwritten
  void take_first(const ConstVectors& of_node, const Vectors& of_orbit) const;

  /// Adds to each node its image of the first node's vector, without components that are zero by symmetry.
  /// @param of_orbit  [n_orbits, 3]  @param of_node  [n_nodes, 3]
  void add_images(const ConstVectors& of_orbit, const Vectors& of_node) const;

 private:
  NodeOrbits orbits_;
  SignGroup group_;
  Kokkos::View<int**, Kokkos::LayoutRight, ExecSpace> image_;  ///< [n_orbits, n_elements], as in NodeOrbits
  Kokkos::View<unsigned*, ExecSpace> vanishing_;               ///< [n_orbits], bit c: component c is zero by symmetry
};

}  // namespace skein
