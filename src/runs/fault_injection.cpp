#include "runs/fault_injection.hpp"

#include <cmath>
#include <cstdlib>
#include <utility>

namespace skein {
namespace {

// The same node at every call of a step; which one depends on the step.
void spoil(const Vectors& vectors, const std::int64_t step) {
  const auto node = static_cast<std::size_t>(7 * step) % vectors.extent(0);
  Kokkos::deep_copy(Kokkos::subview(vectors, std::make_pair(node, node + 1), 1), std::nan(""));
}

Vectors copy(const ConstVectors& vectors) {
  const Vectors result("skein::copy", vectors.extent(0));
  Kokkos::deep_copy(ExecSpace(), result, vectors);
  ExecSpace().fence();
  return result;
}

}  // namespace

FaultOrder read_fault_order() {
  const char* text = std::getenv("SKEIN_TEST_NAN");
  if (text == nullptr) return {};
  const std::string order = text;
  const auto colon = order.find(':');
  if (colon == std::string::npos) return {};
  return {order.substr(0, colon), std::strtol(order.c_str() + colon + 1, nullptr, 10)};
}

void FaultyDynamics::compute_velocity(const double time, const ConstVectors& position, const Vectors& velocity) {
  const bool now = order_.step == step_.number;
  if (now && order_.target == "position") {
    const Vectors spoiled = copy(position);
    spoil(spoiled, order_.step);
    dynamics_.compute_velocity(time, spoiled, velocity);
    return;
  }
  dynamics_.compute_velocity(time, position, velocity);
  ExecSpace().fence();
  if (now && order_.target == "velocity") spoil(velocity, order_.step);
}

void FaultyMobility::add_velocity(const Sources& sources, const ConstVectors& target, const Vectors& velocity) {
  if (order_.step != step_.number || order_.target != "force")
    return mobility_->add_velocity(sources, target, velocity);
  const Vectors spoiled = copy(sources.force);
  spoil(spoiled, order_.step);
  mobility_->add_velocity({sources.position, spoiled, sources.blob}, target, velocity);
}

}  // namespace skein
