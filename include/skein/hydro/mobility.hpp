#pragma once

#include <skein/core/types.hpp>

#include <string>

namespace skein {

/// Point forces on the fluid, each spread over its own blob.
struct Sources {
  ConstVectors position;  ///< [n_sources, 3], length
  ConstVectors force;     ///< [n_sources, 3], force exerted BY the node ON the fluid
  ConstScalars blob;      ///< [n_sources], regularization length, > 0
};

/// Fluid response to forces: velocity += M(target, source) force. Free space, no inertia; self terms are included.
/// There is no set-up protocol: positions are arguments of the call. Implementations agree within their stated error;
/// DirectMobility is the reference, and tests/property holds every implementation to the same properties.
class Mobility {
 public:
  virtual ~Mobility() = default;

  /// @param target    [n_targets, 3], length. The same array as sources.position where the sources are the targets.
  /// @param velocity  [n_targets, 3], length / time. Accumulated into, never overwritten.
  ///
  /// Coincident nodes are allowed. Returns before a device has finished; fence or deep_copy before reading.
  /// The result does not depend on the number of threads.
  /// @throws Error(internal) if extents differ. Non-finite input is not searched for here: the time step checks.
  virtual void add_velocity(const Sources& sources, const ConstVectors& target, const Vectors& velocity) = 0;

  /// Source-target pairs a direct sum would have needed for the calls so far: the unit of the cost card.
  virtual double pairs() const = 0;

  /// One line for the first lines of a run: method, precision, why.
  virtual std::string describe() const = 0;
};

}  // namespace skein
