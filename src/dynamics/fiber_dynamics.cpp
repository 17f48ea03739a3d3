#include <skein/dynamics/fiber_dynamics.hpp>

#include "kernels/node_fault.hpp"

#include <fmt/format.h>

#include <chrono>
#include <numbers>
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

double wait_and_look() {
  ExecSpace().fence();
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Times the two parts of an evaluation, once the device is idle; on a device only one evaluation in many.
class PartsTimer {
 public:
  PartsTimer(const std::int64_t evaluation, FiberDynamics::Seconds& seconds)
      : timed_(evaluation % evaluations_per_timing == 0), seconds_(seconds), start_(timed_ ? wait_and_look() : 0.0) {}
  PartsTimer(const PartsTimer&) = delete;
  PartsTimer& operator=(const PartsTimer&) = delete;

  void begin_fluid() {
    if (!timed_) return;
    fluid_start_ = wait_and_look();
    seconds_.springs_and_flow += evaluations_per_timing * (fluid_start_ - start_);
  }
  ~PartsTimer() {
    if (timed_ && fluid_start_ > 0.0) seconds_.fluid += evaluations_per_timing * (wait_and_look() - fluid_start_);
  }

 private:
  bool timed_;
  FiberDynamics::Seconds& seconds_;
  double start_;
  double fluid_start_ = 0.0;
};

}  // namespace

FiberDynamics::FiberDynamics(const std::vector<Fiber>& fibers, std::unique_ptr<SpringForces> springs,
                             std::unique_ptr<BackgroundFlow> flow, std::unique_ptr<Mobility> mobility,
                             std::unique_ptr<SectionRepulsion> repulsion)
    : fibers_(fibers),
      springs_(std::move(springs)),
      flow_(std::move(flow)),
      mobility_(std::move(mobility)),
      repulsion_(std::move(repulsion)),
      blob_(to_device("skein::FiberDynamics::blob", make_blobs(fibers))),
      force_("skein::FiberDynamics::force", static_cast<std::size_t>(count_nodes(fibers))) {}

void FiberDynamics::compute_velocity(const double time, const ConstVectors& position, const Vectors& velocity) {
  PartsTimer timer(evaluations_++, seconds_);
  Kokkos::deep_copy(ExecSpace(), velocity, 0.0);
  flow_->add_velocity(time, position, velocity);
  springs_->compute_forces(position, force_);
  if (repulsion_ != nullptr) repulsion_->add_forces(position, force_);
  timer.begin_fluid();
  mobility_->add_velocity({position, force_, blob_}, position, velocity);
}

void FiberDynamics::multiply(const ConstVectors& position, const ConstVectors& displacement, const Vectors& result) {
  PartsTimer timer(evaluations_++, seconds_);
  Kokkos::deep_copy(ExecSpace(), result, 0.0);
  springs_->compute_force_changes(position, displacement, force_);
  if (repulsion_ != nullptr) repulsion_->add_force_changes(position, displacement, force_);
  timer.begin_fluid();
  mobility_->add_velocity({position, force_, blob_}, position, result);
}

std::vector<double> FiberDynamics::compute_energies(const ConstVectors& position) const {
  std::vector<double> energy = springs_->compute_energies(position);
  if (repulsion_ != nullptr) repulsion_->add_energies(position, energy);
  return energy;
}

// One source and its own velocity, f / (4 pi viscosity blob), tell the viscosity of any mobility.
double FiberDynamics::measure_viscosity() {
  const Vectors position = to_device("skein::FiberDynamics::one", std::vector<Vec3>{Vec3{}});
  const Vectors force = to_device("skein::FiberDynamics::one", std::vector<Vec3>{Vec3{1.0, 0.0, 0.0}});
  const Vectors velocity("skein::FiberDynamics::one", 1);
  const double blob = fibers_.front().config.blob;
  mobility_->add_velocity({position, force, to_device("skein::FiberDynamics::one", std::vector<double>{blob})},
                          position, velocity);
  return 1.0 / (4.0 * std::numbers::pi * blob * to_host(ConstVectors(velocity)).front().x);
}

Linearization* FiberDynamics::linearization() {
  if (linearization_ == nullptr)
    linearization_ = std::make_unique<FiberLinearization>(
        fibers_, measure_viscosity(),
        [this](const ConstVectors& position, const ConstVectors& displacement, const Vectors& result) {
          multiply(position, displacement, result);
        });
  return linearization_.get();
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
