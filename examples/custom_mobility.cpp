// A mobility of one's own in a scene: free draining, where each node feels its own blob's drag and none of the others.
// Without hydrodynamic interactions a fiber is far easier to stretch than it is in a real fluid.

#include <skein/arrays/runtime.hpp>
#include <skein/physics/physics.hpp>

#include <cstdio>
#include <numbers>

namespace {

/// velocity = force / (4 pi viscosity blob): the velocity of a regularized Stokeslet at its own point.
class FreeDraining final : public skein::Mobility {
 public:
  explicit FreeDraining(const double viscosity) : viscosity_(viscosity) {}

  void add_velocity(const skein::Sources& sources, const skein::ConstVectors& target,
                    const skein::Vectors& velocity) override {
    if (target.data() != sources.position.data()) return;  // elsewhere nothing moves
    const double factor = 1.0 / (4.0 * std::numbers::pi * viscosity_);
    const skein::ConstVectors force = sources.force;
    const skein::ConstScalars blob = sources.blob;
    Kokkos::parallel_for(
        "example::FreeDraining", Kokkos::RangePolicy<skein::ExecSpace>(0, target.extent_int(0)),
        KOKKOS_LAMBDA(const int i) {
          for (int c = 0; c < 3; ++c) velocity(i, c) += factor / blob(i) * force(i, c);
        });
    pairs_ += static_cast<double>(target.extent(0));
  }
  double pairs() const override { return pairs_; }
  std::string describe() const override { return "free draining"; }
  void visit_memory(skein::MemoryVisitor&) override {}

 private:
  double viscosity_, pairs_ = 0.0;
};

/// Mean velocity along x of a fiber along x on whose nodes a unit force along x is shared out.
double speed(skein::Physics& physics) {
  const auto nodes = skein::make_surface_nodes(physics.fibers);
  const double n = static_cast<double>(nodes.size());
  const auto position = skein::to_device("position", nodes);
  const auto force = skein::to_device("force", std::vector<skein::Vec3>(nodes.size(), {1.0 / n, 0.0, 0.0}));
  const skein::Vectors velocity("velocity", nodes.size());
  physics.mobility->add_velocity({position, force, physics.blob}, position, velocity);
  double sum = 0.0;
  for (const skein::Vec3 u : skein::to_host(skein::ConstVectors(velocity))) sum += u.x / n;
  return sum;
}

}  // namespace

int main() {
  const skein::Runtime runtime;
  skein::SceneConfig scene;
  scene.fibers.resize(1);
  skein::Physics physics = skein::make_physics(scene);
  const double interacting = speed(physics);
  physics.mobility = std::make_unique<FreeDraining>(physics.viscosity);
  const double draining = speed(physics);
  std::printf("a unit force moves the fiber at %.4g in the fluid, at %.4g where nodes do not drag each other\n",
              interacting, draining);
  return interacting > 5.0 * draining ? 0 : 1;
}
