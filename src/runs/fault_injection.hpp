#pragma once

#include <skein/physics/mobility.hpp>
#include <skein/solvers/right_hand_side.hpp>

#include <memory>
#include <string>

namespace skein {

/// For tests: SKEIN_TEST_NAN=<position|force|velocity>:<step> in the environment makes one component of one node's
/// position, force or velocity not a number in every evaluation of that step (1 is the first).
struct FaultOrder {
  std::string target;  ///< empty: none
  std::int64_t step = 0;
};
FaultOrder read_fault_order();

/// Which step is being taken; the decorators below look at it.
struct CurrentStep {
  std::int64_t number = 0;
};

/// Spoils positions or velocities.
class FaultyDynamics final : public RightHandSide {
 public:
  FaultyDynamics(RightHandSide& dynamics, FaultOrder order, const CurrentStep& step)
      : dynamics_(dynamics), order_(std::move(order)), step_(step) {}

  void compute_velocity(double time, const ConstVectors& position, const Vectors& velocity) override;
  std::string find_fault(const ConstVectors& position) const override { return dynamics_.find_fault(position); }
  std::int64_t evaluations() const override { return dynamics_.evaluations(); }
  Linearization* linearization() override { return dynamics_.linearization(); }

 private:
  RightHandSide& dynamics_;
  FaultOrder order_;
  const CurrentStep& step_;
};

/// Spoils forces.
class FaultyMobility final : public Mobility {
 public:
  FaultyMobility(std::unique_ptr<Mobility> mobility, FaultOrder order, const CurrentStep& step)
      : mobility_(std::move(mobility)), order_(std::move(order)), step_(step) {}

  void add_velocity(const Sources& sources, const ConstVectors& target, const Vectors& velocity) override;
  double pairs() const override { return mobility_->pairs(); }
  std::string describe() const override { return mobility_->describe(); }
  void visit_memory(MemoryVisitor& visitor) override { mobility_->visit_memory(visitor); }
  ErrorRecord error_record() const override { return mobility_->error_record(); }
  std::vector<std::string> take_messages() override { return mobility_->take_messages(); }

 private:
  std::unique_ptr<Mobility> mobility_;
  FaultOrder order_;
  const CurrentStep& step_;
};

}  // namespace skein
