#pragma once

#include <skein/arrays/memory_visitor.hpp>
#include <skein/arrays/sources.hpp>
#include <skein/arrays/types.hpp>
#include <skein/physics/error_record.hpp>

#include <string>
#include <vector>

namespace skein {

/// Nodes along fibers, as far as the cost of a sum over them depends on them.
struct NodeLines {
  double n_nodes = 0.0;
  double length = 0.0;    ///< of all fibers together
  double max_blob = 0.0;  ///< length
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

  /// From here to the end of a time step, nodes move little from call to call: what was made for their places may serve
  /// several calls. The first call in a step depends on nothing before it, and so does every call outside of steps.
  virtual void begin_step() {}
  virtual void end_step() noexcept {}

  /// True where all sums are ranks' (SumTeam), so that they may leave velocities with those that own the nodes.
  virtual bool sums_by_ranks() const { return false; }

  /// Of velocities, relative (2-norm); 0 where it is that of double precision.
  virtual double expected_error() const { return 0.0; }

  /// Of one sum whose sources are its targets: its time over that of a direct sum in double precision without any
  /// symmetry. What is decided by it is decided alike in every run: it follows from the arguments, never from clocks or
  /// from calls before.
  virtual double relative_cost(const NodeLines& /*nodes*/) const { return 1.0; }

  /// Source-target pairs a direct sum would have needed for the calls so far: the unit of the cost card.
  virtual double pairs() const = 0;

  /// One line for the first lines of a run: method, precision, expected error.
  virtual std::string describe() const = 0;

  /// All that later calls depend on besides their arguments, and the error record: what a restart needs. An integrator
  /// whose step fails brings it back.
  virtual void visit_memory(MemoryVisitor& visitor) = 0;

  /// Of a method without an error of its own, empty.
  virtual ErrorRecord error_record() const { return {}; }

  /// What the user should be told of the calls since this was last asked, one text each.
  virtual std::vector<std::string> take_messages() { return {}; }
};

}  // namespace skein
