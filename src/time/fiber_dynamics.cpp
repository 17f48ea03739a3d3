#include <skein/time/fiber_dynamics.hpp>

#include "kernels/node_fault.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace skein {
namespace {

std::string describe_fault(const ConstVectors& position, const Fiber& fiber, const int fiber_index, const int node) {
  const int in_fiber = node - fiber.first_node;
  const int section = in_fiber / fiber.config.nodes_per_section;
  const auto range = std::make_pair(node, node + 1);
  const Vec3 x = to_host(Kokkos::subview(position, range, Kokkos::ALL())).front();
  return fmt::format(
      "node {} (fiber {}, section {}, node {} of the section) at ({:.6g}, {:.6g}, {:.6g}) is not finite, or farther "
      "than "
      "{:g} radii from its section's centre",
      node, fiber_index, section, in_fiber % fiber.config.nodes_per_section, x.x, x.y, x.z, FiberDynamics::burst_ratio);
}

constexpr int evaluations_per_timing = on_host<ExecSpace> ? 1 : 16;

// Seconds since `start`, once the device is idle.
double wait_and_look(const double start) {
  ExecSpace().fence();
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count() - start;
}

}  // namespace

FiberDynamics::FiberDynamics(const std::vector<Fiber>& fibers, std::unique_ptr<SpringForces> springs,
                             std::unique_ptr<BackgroundFlow> flow, std::unique_ptr<Mobility> mobility)
    : fibers_(fibers),
      springs_(std::move(springs)),
      flow_(std::move(flow)),
      mobility_(std::move(mobility)),
      blob_(to_device("skein::FiberDynamics::blob", make_blobs(fibers))),
      force_("skein::FiberDynamics::force", static_cast<std::size_t>(count_nodes(fibers))) {}

void FiberDynamics::compute_velocity(const double time, const ConstVectors& position, const Vectors& velocity) {
  const bool timed = evaluations_ % evaluations_per_timing == 0;
  ++evaluations_;
  const double start = timed ? wait_and_look(0.0) : 0.0;
  Kokkos::deep_copy(ExecSpace(), velocity, 0.0);
  flow_->add_velocity(time, position, velocity);
  springs_->compute_forces(position, force_);
  const double springs_and_flow = timed ? wait_and_look(start) : 0.0;
  mobility_->add_velocity({position, force_, blob_}, position, velocity);
  if (!timed) return;
  seconds_.springs_and_flow += evaluations_per_timing * springs_and_flow;
  seconds_.fluid += evaluations_per_timing * (wait_and_look(start) - springs_and_flow);
}

std::string FiberDynamics::find_fault(const ConstVectors& position) const {
  for (std::size_t f = 0; f < fibers_.size(); ++f) {
    const Fiber& fiber = fibers_[f];
    const int node = find_faulty_node<ExecSpace>(
        ExecSpace(), position,
        {fiber.first_node, fiber.config.sections, fiber.config.nodes_per_section, fiber.config.radius}, burst_ratio);
    if (node >= 0) return describe_fault(position, fiber, static_cast<int>(f), node);
  }
  return {};
}

}  // namespace skein
