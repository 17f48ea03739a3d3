#pragma once

#include <skein/physics/mobility.hpp>

#include <vector>

namespace skein::perf {

/// Nodes with random forces and one blob, whose velocities are summed.
struct SumProblem {
  SumProblem(const std::vector<Vec3>& nodes, double blob_size);

  Sources sources() const { return {position, force, blob}; }

  /// A little, and not all alike: what is made of positions is made anew.
  void move_nodes();

  /// Overwrites the velocities.
  void compute(Mobility& mobility);

  int n;
  Vectors position, force, velocity;
  Scalars blob;
};

/// Of velocities, together (2-norm).
double relative_error(const std::vector<Vec3>& got, const std::vector<Vec3>& exact);

}  // namespace skein::perf
