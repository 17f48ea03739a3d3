#pragma once

#include <skein/dynamics/constrained_motion.hpp>
#include <skein/dynamics/fiber_linearization.hpp>
#include <skein/physics/physics.hpp>
#include <skein/solvers/right_hand_side.hpp>

#include <memory>
#include <string>

namespace skein {

/// Fibers in a viscous fluid: velocity = background flow + M(position) force(position), the force with what keeps rigid
/// fibers rigid (see ConstrainedMotion).
class FiberDynamics final : public RightHandSide {
 public:
  /// @param physics  must outlive the object
  explicit FiberDynamics(Physics& physics);

  void compute_velocity(double time, const ConstVectors& position, const Vectors& velocity) override;

  /// A node that is not finite, or so far from its section's centre that no spring network holds it: a section of
  /// radius R whose node is at more than burst_ratio R has burst.
  std::string find_fault(const ConstVectors& position) const override;
  void seek_fault(const ConstVectors& position) override;
  static constexpr double burst_ratio = 2.0;

  /// Rigid fibers' nodes are put onto the rigid body that fits them best.
  void project(const Vectors& position) override;

  void begin_step() override { physics_.mobility->begin_step(); }
  void end_step() noexcept override { physics_.mobility->end_step(); }

  std::int64_t evaluations() const override { return evaluations_; }
  const TimeCourse& time_course() const override { return course_; }

  /// What the mobility remembers.
  void visit_memory(MemoryVisitor& visitor) override { physics_.mobility->visit_memory(visitor); }

  /// Where ranks own the nodes, in parts.
  NodeVectors& vectors() override;

  /// M(position) dF/dx: neither the flow's gradient nor the change of M, which are no faster than the shear.
  /// Null where a fiber is rigid: what keeps it so answers every displacement of the others.
  Linearization* linearization() override;

  /// Evaluations are timed from here on, or no longer: each of their parts then waits for the device to finish.
  void time_parts(const bool times_parts) { times_parts_ = times_parts; }

  /// Wall time of the parts of evaluations that were timed, seconds.
  struct Seconds {
    double fluid = 0.0;
    double springs_and_flow = 0.0;
  };
  const Seconds& seconds() const { return seconds_; }

  const Physics& physics() const { return physics_; }

 private:
  void multiply(double time, const ConstVectors& position, const ConstVectors& displacement, const Vectors& result);
  bool has_parts(const ConstVectors& vectors) const;
  NodeVectors& vectors_of(const ConstVectors& vectors) const;
  ConstVectors all_of(const ConstVectors& position) const;
  std::string describe_fault(const ConstVectors& position, int node) const;

  Physics& physics_;
  TimeCourse course_;
  ConstrainedMotion motion_;
  Vectors force_, places_;
  std::int64_t evaluations_ = 0;
  mutable ConstVectors sought_;  ///< positions of the last seek_fault, until they are asked for
  bool times_parts_ = false;
  Seconds seconds_;
  std::unique_ptr<FiberLinearization> linearization_;
};

}  // namespace skein
