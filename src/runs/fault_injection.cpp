#include "runs/fault_injection.hpp"

#include <skein/solvers/right_hand_side_decorator.hpp>

#include "runs/test_order.hpp"

#include <cmath>

namespace skein {
namespace {

// The same node at every call of a step; which one depends on the step.
void spoil(const Vectors& vectors, const std::int64_t step) {
  const auto node = static_cast<std::size_t>(7 * step) % vectors.extent(0);
  Kokkos::deep_copy(Kokkos::subview(vectors, std::make_pair(node, node + 1), 1), std::nan(""));
}

Vectors copy(const ConstVectors& vectors, const int n_nodes, NodeVectors& nodes = whole_vectors()) {
  const Vectors result = nodes.make("skein::fault_injection::copy", n_nodes);
  nodes.copy(result, vectors);
  ExecSpace().fence();
  return result;
}

/// An order and the run that it is given to.
struct Fault {
  FaultOrder order;
  const State& state;
  bool is_due(const FaultOrder::Target target) const { return order.target == target && order.step == state.step + 1; }
};

/// Spoils positions or velocities.
class FaultyDynamics final : public RightHandSideDecorator {
 public:
  FaultyDynamics(RightHandSide& dynamics, Fault fault) : RightHandSideDecorator(dynamics), fault_(fault) {}

  void compute_velocity(const double time, const ConstVectors& position, const Vectors& velocity) override {
    if (fault_.is_due(FaultOrder::Target::position)) {
      const Vectors spoiled = copy(position, fault_.state.position.extent_int(0), vectors());
      spoil(spoiled, fault_.order.step);
      inner_.compute_velocity(time, spoiled, velocity);
      return;
    }
    inner_.compute_velocity(time, position, velocity);
    ExecSpace().fence();
    if (fault_.is_due(FaultOrder::Target::velocity)) spoil(velocity, fault_.order.step);
  }

 private:
  Fault fault_;
};

/// Spoils forces.
class FaultyMobility final : public Mobility {
 public:
  FaultyMobility(std::unique_ptr<Mobility> mobility, Fault fault) : mobility_(std::move(mobility)), fault_(fault) {}

  void add_velocity(const Sources& sources, const ConstVectors& target, const Vectors& velocity) override {
    if (!fault_.is_due(FaultOrder::Target::force)) return mobility_->add_velocity(sources, target, velocity);
    const Vectors spoiled = copy(sources.force, sources.force.extent_int(0));
    spoil(spoiled, fault_.order.step);
    mobility_->add_velocity({sources.position, spoiled, sources.blob}, target, velocity);
  }
  void begin_step() override { mobility_->begin_step(); }
  void end_step() noexcept override { mobility_->end_step(); }
  bool sums_by_ranks() const override { return mobility_->sums_by_ranks(); }
  double expected_error() const override { return mobility_->expected_error(); }
  double relative_cost(const NodeLines& nodes) const override { return mobility_->relative_cost(nodes); }
  double pairs() const override { return mobility_->pairs(); }
  std::string describe() const override { return mobility_->describe(); }
  void visit_memory(MemoryVisitor& visitor) override { mobility_->visit_memory(visitor); }
  ErrorRecord error_record() const override { return mobility_->error_record(); }
  std::vector<std::string> take_messages() override { return mobility_->take_messages(); }

 private:
  std::unique_ptr<Mobility> mobility_;
  Fault fault_;
};

}  // namespace

RunHooks make_fault_hooks(const FaultOrder& order) {
  return {.prepare =
              [order](Physics& physics, const State& state) {
                if (order.target == FaultOrder::Target::force)
                  physics.mobility = std::make_unique<FaultyMobility>(std::move(physics.mobility), Fault{order, state});
              },
          .decorate = [order](RightHandSide& dynamics, const State& state) -> std::unique_ptr<RightHandSide> {
            return std::make_unique<FaultyDynamics>(dynamics, Fault{order, state});
          }};
}

RunHooks read_fault_hooks() {
  const auto [target, step] = read_test_order("SKEIN_TEST_NAN");
  if (target == "position") return make_fault_hooks({FaultOrder::Target::position, step});
  if (target == "force") return make_fault_hooks({FaultOrder::Target::force, step});
  if (target == "velocity") return make_fault_hooks({FaultOrder::Target::velocity, step});
  return {};
}

}  // namespace skein
