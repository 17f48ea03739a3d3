#include <skein/arrays/launch.hpp>
#include <skein/core/error.hpp>

#include "force_table.hpp"
#include "motion_times.hpp"
#include "node_sums.hpp"

#include <fmt/format.h>

namespace skein {
namespace {

/// What each node weighs: a fiber's excess weight per length is shared equally by its nodes.
std::vector<double> make_weights(const std::vector<Fiber>& fibers, const double per_length) {
  std::vector<double> weight;
  for (const Fiber& fiber : fibers)
    weight.insert(weight.end(), static_cast<std::size_t>(fiber.n_nodes()),
                  per_length * fiber.spacing() / fiber.config.nodes_per_section);
  return weight;
}

/// Of a node, which is higher where it is less far down.
struct WeightEnergy {
  ConstScalars weight;
  Vec3 down;
  ConstVectors position;
  KOKKOS_INLINE_FUNCTION double operator()(const int node) const {
    return -weight(node) * dot(down, load(position, node));
  }
};

/// The weight of fibers in the fluid, less the fluid's: the same everywhere and at all times. Its sum is not zero, so
/// that the fluid as a whole is dragged along and velocities fall off like 1 / distance only.
class Gravity final : public Force {
 public:
  Gravity(const std::vector<Fiber>& fibers, const double weight, const Vec3 direction, const double viscosity)
      : weight_(weight),
        time_scale_(find_falling_time(weight, fibers, viscosity)),
        direction_(direction / norm(direction)),
        node_weight_(to_device("skein::Gravity::node_weight", make_weights(fibers, weight))),
        energy_("skein::Gravity::node_energy", fibers, node_weight_.extent(0)) {}

  ForcePromises promises() const override { return {.is_conservative = true, .is_steady = true, .reach = 0}; }

  void add_forces(const double time, const ConstVectors& position, const Vectors& force) const override {
    add_forces_on(0, force.extent_int(0), time, {position, {}, {}, {}}, force);
  }

  void add_forces_on(const int first, const int n, double /*time*/, const SeenNodes& nodes,
                     const Vectors& force) const override {
    SKEIN_REQUIRE(nodes.position.extent(0) == node_weight_.extent(0) && force.extent(0) == nodes.position.extent(0),
                  "positions and forces are those of the fibers' nodes");
    const ConstScalars weight = node_weight_;
    const Vec3 down = direction_;
    launch<ExecSpace>(
        "skein::add_gravity", ExecSpace(), Calls{n, 10.0}, KOKKOS_LAMBDA(const int i) {
          const int node = first + i;
          store(force, node, load(force, node) + weight(node) * down);
        });
  }

  void add_force_changes(double /*time*/, const ConstVectors& /*position*/, const ConstVectors& /*displacement*/,
                         const Vectors& /*change*/) const override {}

  void seek_measures(double /*time*/, const ConstVectors& position) const override {
    energy_.seek("skein::compute_gravity_energy", WeightEnergy{node_weight_, direction_, position});
  }
  void add_found_energies(std::vector<double>& energy) const override { energy_.add_found(energy); }

  double time_scale() const override { return time_scale_; }

  std::string describe() const override {
    return fmt::format("gravity, {:g} a length towards ({:g}, {:g}, {:g})", weight_, direction_.x, direction_.y,
                       direction_.z);
  }

 private:
  double weight_;
  double time_scale_;
  Vec3 direction_;
  Scalars node_weight_;  ///< [n_nodes]
  NodeSums energy_;
};

}  // namespace

void append_gravity(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces) {
  const GravityConfig& gravity = scene.gravity;
  if (gravity.weight > 0.0)
    forces.push_back(std::make_unique<Gravity>(fibers, gravity.weight, gravity.direction, scene.fluid.viscosity));
}

}  // namespace skein
