// A force of one's own beside a scene's: a harmonic trap that holds every node in the plane y = 0. In a shear flow
// whose velocity is (r y, 0, 0) the fiber then stays where it is.

#include <skein/arrays/runtime.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/dynamics/make_integrator.hpp>

#include <cmath>
#include <cstdio>

namespace {

/// Pulls nodes to the plane y = 0 with a force of -stiffness y each.
class PlaneTrap final : public skein::Force {
 public:
  explicit PlaneTrap(const double stiffness) : stiffness_(stiffness) {}

  skein::ForcePromises promises() const override { return {.is_steady = true}; }

  void add_forces(double /*time*/, const skein::ConstVectors& position, const skein::Vectors& force) const override {
    add_pull(position, force);
  }

  // The force is linear: its change with the positions is what it does to displacements.
  void add_force_changes(double /*time*/, const skein::ConstVectors& /*position*/,
                         const skein::ConstVectors& displacement, const skein::Vectors& change) const override {
    add_pull(displacement, change);
  }

  std::string describe() const override { return "trap in the plane y = 0"; }

  void add_pull(const skein::ConstVectors& x, const skein::Vectors& sum) const {
    const double k = stiffness_;
    Kokkos::parallel_for(
        "example::PlaneTrap", Kokkos::RangePolicy<skein::ExecSpace>(0, x.extent_int(0)),
        KOKKOS_LAMBDA(const int i) { sum(i, 1) -= k * x(i, 1); });
  }

 private:
  double stiffness_;
};

/// How far a fiber that lies at an angle to the flow has turned at t = 1, radians.
double turn(const double trap) {
  skein::SceneConfig scene;
  skein::FiberConfig fiber;
  fiber.sections = 20;
  fiber.nodes_per_section = 6;
  fiber.direction = {1.0, 0.2, 0.0};
  fiber.blob = 0.005;
  scene.fibers = {fiber};
  skein::Physics physics = skein::make_physics(scene);
  if (trap > 0.0) physics.forces.push_back(std::make_unique<PlaneTrap>(trap));
  skein::FiberDynamics dynamics(physics);
  const auto integrator = skein::make_integrator(scene, physics, dynamics);
  skein::State state{0.0, 0, skein::to_device("position", skein::make_surface_nodes(physics.fibers))};
  while (state.time < 1.0) integrator->advance(state, 1.0);
  const auto line = physics.sections.compute_centreline(state.position);
  const skein::Vec3 along = line.back() - line.front();
  return std::abs(std::atan2(along.y, along.x));
}

}  // namespace

int main() {
  const skein::Runtime runtime;
  const double free = turn(0.0), trapped = turn(0.01);
  std::printf("angle to the flow at t = 1: %.4f free, %.4f in the trap\n", free, trapped);
  return trapped < 0.2 * free ? 0 : 1;
}
