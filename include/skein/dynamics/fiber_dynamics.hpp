#pragma once

#include <skein/dynamics/fiber_linearization.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/physics/background_flow.hpp>
#include <skein/physics/mobility.hpp>
#include <skein/physics/section_repulsion.hpp>
#include <skein/physics/spring_forces.hpp>
#include <skein/solvers/right_hand_side.hpp>

#include <memory>
#include <string>
#include <vector>

namespace skein {

/// Fibers in a viscous fluid: velocity = background flow + M(position) force(position), the force of springs and of the
/// repulsion where there is one.
class FiberDynamics final : public RightHandSide {
 public:
  /// @param repulsion  null: none
  FiberDynamics(const std::vector<Fiber>& fibers, std::unique_ptr<SpringForces> springs,
                std::unique_ptr<BackgroundFlow> flow, std::unique_ptr<Mobility> mobility,
                std::unique_ptr<SectionRepulsion> repulsion = nullptr);

  void compute_velocity(double time, const ConstVectors& position, const Vectors& velocity) override;

  /// A node that is not finite, or so far from its section's centre that no spring network holds it: a section of
  /// radius R whose node is at more than burst_ratio R has burst.
  std::string find_fault(const ConstVectors& position) const override;
  static constexpr double burst_ratio = 2.0;

  std::int64_t evaluations() const override { return evaluations_; }

  /// All that later velocities depend on besides the arguments: the mobility's.
  void visit_memory(MemoryVisitor& visitor) { mobility_->visit_memory(visitor); }
  std::vector<std::string> take_messages() { return mobility_->take_messages(); }

  /// Of springs and repulsion, force * length. @returns [n_fibers]
  std::vector<double> compute_energies(const ConstVectors& position) const;

  /// M(position) dF/dx: neither the flow's gradient nor the change of M, which are no faster than the shear.
  Linearization* linearization() override;

  /// Wall time spent in evaluations, by parts, seconds. On a device, where waiting costs, an estimate from one in
  /// sixteen of them.
  struct Seconds {
    double fluid = 0.0;
    double springs_and_flow = 0.0;
  };
  const Seconds& seconds() const { return seconds_; }

  const SpringForces& springs() const { return *springs_; }
  const SectionRepulsion* repulsion() const { return repulsion_.get(); }  ///< null: none
  const BackgroundFlow& flow() const { return *flow_; }
  const Mobility& mobility() const { return *mobility_; }

 private:
  double measure_viscosity();
  void multiply(const ConstVectors& position, const ConstVectors& displacement, const Vectors& result);

  std::vector<Fiber> fibers_;
  std::unique_ptr<SpringForces> springs_;
  std::unique_ptr<BackgroundFlow> flow_;
  std::unique_ptr<Mobility> mobility_;
  std::unique_ptr<SectionRepulsion> repulsion_;
  Scalars blob_;
  Vectors force_;
  std::int64_t evaluations_ = 0;
  Seconds seconds_;
  std::unique_ptr<FiberLinearization> linearization_;
};

}  // namespace skein
