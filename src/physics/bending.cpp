#include <skein/arrays/launch.hpp>
#include <skein/core/error.hpp>
#include <skein/fibers/spring_network.hpp>

#include "force_table.hpp"
#include "node_sums.hpp"

#include <algorithm>

namespace skein {
namespace {

/// What resists bending at each node, EI / spacing, force * length: 0 where two links of a chain do not meet.
std::vector<double> make_resistances(const std::vector<Fiber>& fibers) {
  std::vector<double> resistance;
  for (const Fiber& fiber : fibers) {
    const SpringNetwork network = make_spring_network(fiber);
    for (int node = 0; node < fiber.n_nodes(); ++node) {
      const bool bends = fiber.config.model == FiberModel::chain && node > 0 && node + 1 < fiber.n_nodes();
      resistance.push_back(bends ? network.factor(node, 0) * fiber.config.bending_rigidity / fiber.spacing() : 0.0);
    }
  }
  return resistance;
}

/// One of the two links that meet at a node.
struct Link {
  Vec3 direction;
  double inverse_length;

  SKEIN_INLINE_FUNCTION explicit Link(const Vec3 d) {
    const double square = dot(d, d);
    inverse_length = square > 0.0 ? math::inverse_sqrt(square) : 0.0;  // a link of length zero has no direction
    direction = inverse_length * d;
  }
  /// The part across the link, over its length: how the direction changes where the link changes by v.
  SKEIN_INLINE_FUNCTION Vec3 turn_by(const Vec3 v) const {
    return inverse_length * (v - dot(direction, v) * direction);
  }
};

/// Forces at a bend on the far ends of its two links; the node between them has minus their sum.
struct EndForces {
  Vec3 before, after;
};

SKEIN_INLINE_FUNCTION EndForces forces_of(const double resistance, const Link& a, const Link& b) {
  return {-resistance * a.turn_by(b.direction), resistance * b.turn_by(a.direction)};
}

/// The first-order change of link.turn_by(other) where the link changes by v and the other direction by `other_turn`.
SKEIN_INLINE_FUNCTION Vec3 change_turn(const Link& link, const Vec3 v, const Vec3 other, const Vec3 other_turn) {
  const Vec3 turn = link.turn_by(v);
  const double stretch = link.inverse_length * dot(link.direction, v);
  return link.turn_by(other_turn) -
         link.inverse_length * (dot(turn, other) * link.direction + dot(link.direction, other) * turn) -
         stretch * link.turn_by(other);
}

/// The first-order change of the forces where the links change by u and v.
SKEIN_INLINE_FUNCTION EndForces changes_of(const double resistance, const Link& a, const Link& b, const Vec3 u,
                                           const Vec3 v) {
  return {-resistance * change_turn(a, u, b.direction, b.turn_by(v)),
          resistance * change_turn(b, v, a.direction, a.turn_by(u))};
}

/// The forces at each bend.
struct BendForces {
  ConstVectors position;

  KOKKOS_INLINE_FUNCTION EndForces operator()(const int bend, const double resistance) const {
    const Vec3 x = load(position, bend);
    return forces_of(resistance, Link(x - load(position, bend - 1)), Link(load(position, bend + 1) - x));
  }
};

/// Their changes.
struct BendChanges {
  ConstVectors position, displacement;

  KOKKOS_INLINE_FUNCTION EndForces operator()(const int bend, const double resistance) const {
    const Vec3 x = load(position, bend), v = load(displacement, bend);
    return changes_of(resistance, Link(x - load(position, bend - 1)), Link(load(position, bend + 1) - x),
                      v - load(displacement, bend - 1), load(displacement, bend + 1) - v);
  }
};

/// The energy of each bend.
struct BendEnergy {
  ConstScalars resistance;
  ConstVectors position;

  KOKKOS_INLINE_FUNCTION double operator()(const int node) const {
    if (resistance(node) == 0.0) return 0.0;
    const Vec3 x = load(position, node);
    const Vec3 turn = Link(load(position, node + 1) - x).direction - Link(x - load(position, node - 1)).direction;
    return 0.5 * resistance(node) * dot(turn, turn);
  }
};

/// Some nodes; each gathers from the three bends that it takes part in, so that no number is written by two threads.
template <class Ends>
void add_by_bends(const char* label, const int first, const int n, const ConstScalars& resistance, const Ends& ends_of,
                  const Vectors& sum) {
  SKEIN_REQUIRE(ends_of.position.extent(0) == resistance.extent(0) && sum.extent(0) == resistance.extent(0),
                "positions and forces are those of the fibers' nodes");
  const int n_nodes = sum.extent_int(0);
  launch<ExecSpace>(
      label, ExecSpace(), Calls{n, 50.0}, KOKKOS_LAMBDA(const int i) {
        const int node = first + i;
        Vec3 own;
        for (int bend = math::larger(0, node - 1); bend <= math::smaller(n_nodes - 1, node + 1); ++bend) {
          if (resistance(bend) == 0.0) continue;
          const EndForces ends = ends_of(bend, resistance(bend));
          if (bend == node)
            own = own - ends.before - ends.after;
          else
            own = own + (bend > node ? ends.before : ends.after);
        }
        store(sum, node, load(sum, node) + own);
      });
}

/// Resistance of chains against bending: the energy EI / (2 spacing) |t' - t|^2 where links of directions t and t'
/// meet.
class Bending final : public Force {
 public:
  explicit Bending(const std::vector<Fiber>& fibers)
      : resistance_(to_device("skein::Bending::resistance", make_resistances(fibers))),
        energy_("skein::Bending::energy", fibers, resistance_.extent(0)) {}

  ForcePromises promises() const override {
    return {.is_balanced = true,
            .is_torque_free = true,
            .is_conservative = true,
            .is_steady = true,
            .is_frame_indifferent = true,
            .reach = 2};
  }

  void add_forces(const double time, const ConstVectors& position, const Vectors& force) const override {
    add_forces_on(0, force.extent_int(0), time, {position, {}, {}, {}}, force);
  }
  void add_force_changes(const double time, const ConstVectors& position, const ConstVectors& displacement,
                         const Vectors& change) const override {
    add_force_changes_on(0, change.extent_int(0), time, {position, {}, displacement, {}}, change);
  }
  void add_forces_on(const int first, const int n, double /*time*/, const SeenNodes& nodes,
                     const Vectors& force) const override {
    add_by_bends("skein::add_bending_forces", first, n, resistance_, BendForces{nodes.position}, force);
  }
  void add_force_changes_on(const int first, const int n, double /*time*/, const SeenNodes& nodes,
                            const Vectors& change) const override {
    add_by_bends("skein::add_bending_force_changes", first, n, resistance_,
                 BendChanges{nodes.position, nodes.displacement}, change);
  }
  void seek_measures(double /*time*/, const ConstVectors& position) const override {
    energy_.seek("skein::compute_bending_energy", BendEnergy{resistance_, position});
  }
  void add_found_energies(std::vector<double>& energy) const override { energy_.add_found(energy); }

  std::string describe() const override { return "bending of chains"; }

 private:
  ConstScalars resistance_;  ///< [n_nodes], force * length
  NodeSums energy_;
};

}  // namespace

void append_bending(const SceneConfig& /*scene*/, const std::vector<Fiber>& fibers, ForceList& forces) {
  if (std::any_of(fibers.begin(), fibers.end(), [](const Fiber& fiber) { return fiber.config.bending_rigidity > 0.0; }))
    forces.push_back(std::make_unique<Bending>(fibers));
}

}  // namespace skein
