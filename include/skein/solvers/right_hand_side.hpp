#pragma once

#include <skein/arrays/memory_visitor.hpp>
#include <skein/arrays/node_vectors.hpp>
#include <skein/arrays/types.hpp>
#include <skein/core/time_course.hpp>
#include <skein/solvers/linearization.hpp>

#include <cstdint>
#include <string>

namespace skein {

/// dx/dt = velocity(t, x): all that an integrator sees of fibers and fluid.
class RightHandSide {
 public:
  virtual ~RightHandSide() = default;

  /// Overwrites velocity, [n_nodes, 3], length / time. Counts as one evaluation.
  virtual void compute_velocity(double time, const ConstVectors& position, const Vectors& velocity) = 0;

  /// What is wrong with these positions, naming the node; empty where they are fit to go on from. One launch and one
  /// wait; after seek_fault no wait.
  virtual std::string find_fault(const ConstVectors& position) const = 0;

  /// Launches what the next find_fault will be asked, with the same positions, after a wait for the execution space
  /// that the caller has anyway. May do nothing.
  virtual void seek_fault(const ConstVectors& /*position*/) {}

  /// Puts positions back among those that it allows, such as those of rigid bodies, from which a step leads away by its
  /// error: integrators do so with what they accept and what they interpolate. Velocities are the same before and
  /// after. Does nothing where all positions are allowed.
  virtual void project(const Vectors& /*position*/) {}

  /// Around every step that an integrator takes or tries to take: between these two, positions differ little from call
  /// to call, and what was made for them may serve on. The first velocity in a step depends on its arguments and on
  /// what visit_memory shows, and on nothing else.
  virtual void begin_step() {}
  virtual void end_step() noexcept {}

  virtual std::int64_t evaluations() const = 0;

  /// All that later velocities depend on besides the arguments.
  virtual void visit_memory(MemoryVisitor& /*visitor*/) {}

  /// When velocities change by themselves: integrators end steps where they are not smooth. At such a time, a velocity
  /// is that of what comes after.
  virtual const TimeCourse& time_course() const {
    static const TimeCourse steady;
    return steady;
  }

  /// What an integrator may work with whose arrays need not be whole. compute_velocity, find_fault and seek_fault take
  /// its arrays as well as whole ones, but not both in one call.
  virtual NodeVectors& vectors() { return whole_vectors(); }

  /// Its stiff part; null where it has none to offer. Belongs to this object.
  virtual Linearization* linearization() { return nullptr; }
};

}  // namespace skein
