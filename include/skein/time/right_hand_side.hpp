#pragma once

#include <skein/core/types.hpp>

#include <cstdint>

namespace skein {

/// dx/dt = velocity(t, x): all that an integrator sees of fibers and fluid.
class RightHandSide {
 public:
  virtual ~RightHandSide() = default;

  /// Overwrites velocity, [n_nodes, 3]. Counts as one evaluation.
  virtual void compute_velocity(double time, const ConstVectors& position, const Vectors& velocity) = 0;

  virtual std::int64_t evaluations() const = 0;
};

}  // namespace skein
