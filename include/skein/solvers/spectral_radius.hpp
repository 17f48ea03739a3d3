#pragma once

#include <skein/arrays/memory_visitor.hpp>
#include <skein/solvers/right_hand_side.hpp>

#include <cstdint>

namespace skein {

/// The largest |eigenvalue| of d velocity / d position, by a power iteration on differences of velocities.
/// For fibers it is real and negative, and belongs to sections that ovalize. The vector is kept from call to call, so
/// that later estimates converge in a few evaluations.
class SpectralRadius {
 public:
  /// @param displacement  root-mean-square displacement of a node in the differences, length; small against the node
  ///                      spacing, large against the rounding of positions.
  /// @param seed          of the first vector
  /// @param vectors       of which positions and velocities are
  SpectralRadius(int n_nodes, double displacement, std::uint64_t seed, NodeVectors& vectors = whole_vectors());

  /// @param velocity  at `position`, already evaluated.
  /// @returns the estimate, 1 / time, from below; the last two iterates agreed within `accuracy`, or max_iterations
  ///          evaluations were spent.
  double estimate(RightHandSide& rhs, double time, const ConstVectors& position, const ConstVectors& velocity,
                  double accuracy, int max_iterations);

  /// The current vector, root-mean-square 1.
  const Vectors& vector() const { return direction_; }
  void visit_memory(MemoryVisitor& visitor) { visitor.node_vectors("spectral_radius.vector", vectors_, direction_); }

 private:
  NodeVectors& vectors_;
  double displacement_;
  Vectors direction_;
  Vectors displaced_;
  Vectors displaced_velocity_;
};

}  // namespace skein
