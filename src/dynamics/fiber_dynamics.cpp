#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/physics/shared_nodes.hpp>

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace skein {
namespace {

double wait_and_look() {
  ExecSpace().fence();
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Times the two parts of an evaluation, waiting for the device before each look at the clock.
class PartsTimer {
 public:
  PartsTimer(const bool timed, FiberDynamics::Seconds& seconds)
      : timed_(timed), seconds_(seconds), start_(timed ? wait_and_look() : 0.0) {}
  PartsTimer(const PartsTimer&) = delete;
  PartsTimer& operator=(const PartsTimer&) = delete;

  void begin_fluid() {
    if (!timed_) return;
    fluid_start_ = wait_and_look();
    seconds_.springs_and_flow += fluid_start_ - start_;
  }
  ~PartsTimer() {
    if (timed_ && fluid_start_ > 0.0) seconds_.fluid += wait_and_look() - fluid_start_;
  }

 private:
  bool timed_;
  FiberDynamics::Seconds& seconds_;
  double start_;
  double fluid_start_ = 0.0;
};

}  // namespace

FiberDynamics::FiberDynamics(Physics& physics)
    : physics_(physics),
      course_(physics.make_time_course()),
      motion_(physics),
      force_("skein::FiberDynamics::force", physics.blob.extent(0)) {
  if (!physics.rigid_bodies.is_empty()) places_ = Vectors("skein::FiberDynamics::places", physics.blob.extent(0));
}

void FiberDynamics::compute_velocity(const double time, const ConstVectors& position, const Vectors& velocity) {
  ++evaluations_;
  PartsTimer timer(times_parts_, seconds_);
  if (has_parts(position)) {
    SharedNodes& nodes = *physics_.shared_nodes;
    const Sources sources = nodes.compute_forces(physics_, time, position, velocity, force_);
    timer.begin_fluid();
    return nodes.add_velocity(physics_, sources, velocity);
  }
  ConstVectors places = position;
  if (!physics_.rigid_bodies.is_empty()) {
    motion_.compute_places(position, places_);
    places = places_;
  }
  physics_.flow->compute_velocity(time, places, velocity);
  physics_.compute_forces(time, places, force_);
  timer.begin_fluid();
  motion_.solve(places, force_, velocity);
  if (physics_.symmetry != nullptr) physics_.symmetry->project(velocity);
}

void FiberDynamics::project(const Vectors& position) {
  if (physics_.rigid_bodies.is_empty()) return;
  motion_.compute_places(position, position);
  if (physics_.symmetry != nullptr) physics_.symmetry->project(position);
}

void FiberDynamics::multiply(const double time, const ConstVectors& position, const ConstVectors& displacement,
                             const Vectors& result) {
  ++evaluations_;
  PartsTimer timer(times_parts_, seconds_);
  if (has_parts(position)) {
    SharedNodes& nodes = *physics_.shared_nodes;
    const Sources sources = nodes.compute_force_changes(physics_, time, position, displacement, result, force_);
    timer.begin_fluid();
    return nodes.add_velocity(physics_, sources, result);
  }
  Kokkos::deep_copy(ExecSpace(), result, 0.0);
  physics_.compute_force_changes(time, position, displacement, force_);
  timer.begin_fluid();
  physics_.mobility->add_velocity({position, force_, physics_.blob, true}, position, result);
  if (physics_.symmetry != nullptr) physics_.symmetry->project(result);
}

Linearization* FiberDynamics::linearization() {
  if (!physics_.rigid_bodies.is_empty()) return nullptr;
  if (linearization_ == nullptr)
    linearization_ = std::make_unique<FiberLinearization>(
        physics_.fibers, physics_.viscosity, physics_.relative_sum_cost(),
        [this](const double time, const ConstVectors& position, const ConstVectors& displacement,
               const Vectors& result) { multiply(time, position, displacement, result); },
        [this](const ConstVectors& vectors) -> NodeVectors& { return vectors_of(vectors); }, physics_.symmetry);
  return linearization_.get();
}

bool FiberDynamics::has_parts(const ConstVectors& vectors) const {
  return physics_.shared_nodes != nullptr && physics_.shared_nodes->have_made(vectors);
}

NodeVectors& FiberDynamics::vectors() {
  if (physics_.shared_nodes != nullptr && physics_.shared_nodes->serve(physics_)) return *physics_.shared_nodes;
  return whole_vectors();
}

NodeVectors& FiberDynamics::vectors_of(const ConstVectors& vectors) const {
  return has_parts(vectors) ? *physics_.shared_nodes : whole_vectors();
}

/// Rank 0 seeks faults among all nodes: it has their positions since they were evaluated.
ConstVectors FiberDynamics::all_of(const ConstVectors& position) const {
  return vectors_of(position).gather_whole(position);
}

void FiberDynamics::seek_fault(const ConstVectors& position) {
  physics_.sections.seek_faulty_node(all_of(position), burst_ratio);
  sought_ = position;
}

std::string FiberDynamics::find_fault(const ConstVectors& position) const {
  const bool is_sought = sought_.data() != nullptr && sought_.data() == position.data();
  sought_ = {};
  const ConstVectors all = all_of(position);
  const int node =
      is_sought ? physics_.sections.found_faulty_node() : physics_.sections.find_faulty_node(all, burst_ratio);
  return node < 0 ? std::string() : describe_fault(all, node);
}

std::string FiberDynamics::describe_fault(const ConstVectors& position, const int node) const {
  const Fiber& fiber = find_fiber_of(physics_.fibers, node);
  const int in_fiber = node - fiber.first_node, n = fiber.config.nodes_per_section;
  const Vec3 x = to_host(Kokkos::subview(position, std::make_pair(node, node + 1), Kokkos::ALL())).front();
  return fmt::format(
      "node {} (fiber {}, section {}, node {} of the section) at ({:.6g}, {:.6g}, {:.6g}) is not finite, or farther "
      "than {:g} radii from its section's centre",
      node, fiber.index, in_fiber / n, in_fiber % n, x.x, x.y, x.z, burst_ratio);
}

}  // namespace skein
