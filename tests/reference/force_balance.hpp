#pragma once

#include <skein/core/vec3.hpp>

#include <vector>

namespace skein::reference {

/// Sums over a run of nodes, and the sums of sizes that rounding is measured by.
struct ForceBalance {
  Vec3 net, torque;  ///< about the origin
  double size = 0.0, moment = 0.0;
};

inline ForceBalance sum_forces(const std::vector<Vec3>& position, const std::vector<Vec3>& force, const int first,
                               const int count) {
  ForceBalance sum;
  for (int i = first; i < first + count; ++i) {
    sum.net = sum.net + force[i];
    sum.torque = sum.torque + cross(position[i], force[i]);
    sum.size += norm(force[i]);
    sum.moment += norm(position[i]) * norm(force[i]);
  }
  return sum;
}

}  // namespace skein::reference
