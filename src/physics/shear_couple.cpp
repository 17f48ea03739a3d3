#include <skein/arrays/launch.hpp>
#include <skein/core/error.hpp>
#include <skein/physics/scene_flow.hpp>

#include "force_table.hpp"
#include "kernels/flow_gradient.hpp"
#include "node_sums.hpp"

#include <algorithm>

namespace skein {
namespace {

/// Couple over the rate of shear on the link from each node to the next, force * length * time; 0 where there is none.
std::vector<double> make_couples(const std::vector<Fiber>& fibers) {
  std::vector<double> couple;
  for (const Fiber& fiber : fibers) {
    const std::size_t first = couple.size(), n_nodes = static_cast<std::size_t>(fiber.n_nodes());
    couple.resize(first + n_nodes);
    if (!fiber.config.is_line()) continue;
    const std::size_t end = first + n_nodes - 1;  // no link begins at the last node
    std::fill(couple.begin() + first, couple.begin() + end, fiber.config.shear_couple * fiber.spacing());
    couple[first] += fiber.config.end_couple;
    couple[end - 1] += fiber.config.end_couple;
  }
  return couple;
}

SKEIN_INLINE_FUNCTION Vec3 across(const Vec3 direction, const Vec3 v) { return v - dot(direction, v) * direction; }

/// On the head of a link of direction e and length r in a flow of gradient G: -couple/r times the part of (G + G^T) e
/// across e. The tail has the opposite force. A surface along e feels the shear G^T e and its own turning; a link turns
/// with G e but for what the drag on its nodes resists, which the blob makes that of the tube, turning surface and all.
SKEIN_INLINE_FUNCTION Vec3 force_on_head(const FlowTerms& terms, const double couple, const Vec3 tail,
                                         const Vec3 head) {
  const double r = norm(head - tail);
  if (!(r > 0.0)) return {};
  const Vec3 e = (head - tail) / r, middle = 0.5 * (tail + head);
  Vec3 growth;
  for (int t = 0; t < terms.n_terms; ++t) growth = growth + gradient_of(terms.term[t], middle).twice_strain(e);
  return (-couple / r) * across(e, growth);
}

/// Its first-order change where the ends move by u and v.
SKEIN_INLINE_FUNCTION Vec3 change_on_head(const FlowTerms& terms, const double couple, const Vec3 tail, const Vec3 head,
                                          const Vec3 u, const Vec3 v) {
  const double r = norm(head - tail);
  if (!(r > 0.0)) return {};
  const Vec3 e = (head - tail) / r, middle = 0.5 * (tail + head), shift = 0.5 * (u + v);
  const Vec3 turn = across(e, v - u) / r;
  const double stretch = dot(e, v - u) / r;
  Vec3 growth, change;
  for (int t = 0; t < terms.n_terms; ++t) {
    const GradientRows rows = gradient_of(terms.term[t], middle);
    growth = growth + rows.twice_strain(e);
    change = change + rows.twice_strain(turn) + gradient_change_of(terms.term[t], middle, shift).twice_strain(e);
  }
  return (-couple / r) *
         (across(e, change) - dot(turn, growth) * e - dot(e, growth) * turn - stretch * across(e, growth));
}

struct HeadForces {
  FlowTerms terms;
  ConstVectors position;

  KOKKOS_INLINE_FUNCTION Vec3 operator()(const int tail, const double couple) const {
    return force_on_head(terms, couple, load(position, tail), load(position, tail + 1));
  }
};

struct HeadChanges {
  FlowTerms terms;
  ConstVectors position, displacement;

  KOKKOS_INLINE_FUNCTION Vec3 operator()(const int tail, const double couple) const {
    return change_on_head(terms, couple, load(position, tail), load(position, tail + 1), load(displacement, tail),
                          load(displacement, tail + 1));
  }
};

/// What the couple on the link from each node does.
struct LinkPower {
  ConstScalars couple;
  HeadForces force;
  ConstVectors velocity;

  KOKKOS_INLINE_FUNCTION double operator()(const int tail) const {
    if (couple(tail) == 0.0) return 0.0;
    return dot(force(tail, couple(tail)), load(velocity, tail + 1) - load(velocity, tail));
  }
};

/// Each node gathers from the two links that end there, so that no number is written by two threads.
template <class OnHead>
void add_by_links(const char* label, const int first, const int n, const ConstScalars& couple, const OnHead& on_head,
                  const Vectors& sum) {
  SKEIN_REQUIRE(on_head.position.extent(0) == couple.extent(0) && sum.extent(0) == couple.extent(0),
                "positions and forces are those of the fibers' nodes");
  launch<ExecSpace>(
      label, ExecSpace(), Calls{n, 25.0}, KOKKOS_LAMBDA(const int i) {
        const int node = first + i;
        Vec3 own;
        if (node > 0 && couple(node - 1) != 0.0) own = own + on_head(node - 1, couple(node - 1));
        if (couple(node) != 0.0) own = own - on_head(node, couple(node));
        store(sum, node, load(sum, node) + own);
      });
}

/// The couple by which a shear turns a tube that lies along it: velocities along the tube grow across it, which its
/// surface feels and a line does not. Pairs of forces on the ends of a chain's links, in the scene's flow.
class ShearCouple final : public Force {
 public:
  ShearCouple(const std::vector<FlowConfig>& flows, const std::vector<Fiber>& fibers)
      : flow_(flows),
        couple_(to_device("skein::ShearCouple::couple", make_couples(fibers))),
        power_("skein::ShearCouple::power", fibers, couple_.extent(0)) {}

  ForcePromises promises() const override { return {.is_balanced = true, .is_steady = flow_.is_steady(), .reach = 1}; }

  void add_forces(const double time, const ConstVectors& position, const Vectors& force) const override {
    add_forces_on(0, force.extent_int(0), time, {position, {}, {}, {}}, force);
  }
  void add_force_changes(const double time, const ConstVectors& position, const ConstVectors& displacement,
                         const Vectors& change) const override {
    add_force_changes_on(0, change.extent_int(0), time, {position, {}, displacement, {}}, change);
  }
  void add_forces_on(const int first, const int n, const double time, const SeenNodes& nodes,
                     const Vectors& force) const override {
    for (const FlowTerms& terms : flow_.make_terms(time))
      add_by_links("skein::add_shear_couple_forces", first, n, couple_, HeadForces{terms, nodes.position}, force);
  }
  void add_force_changes_on(const int first, const int n, const double time, const SeenNodes& nodes,
                            const Vectors& change) const override {
    for (const FlowTerms& terms : flow_.make_terms(time))
      add_by_links("skein::add_shear_couple_force_changes", first, n, couple_,
                   HeadChanges{terms, nodes.position, nodes.displacement}, change);
  }

  // The couple is the flow's, not the gradient of an energy: its work comes from outside.
  void add_drive_powers(const double time, const ConstVectors& position, const ConstVectors& velocity,
                        std::vector<double>& power) const override {
    for (const FlowTerms& terms : flow_.make_terms(time))
      power_.add("skein::compute_shear_couple_power", power, LinkPower{couple_, HeadForces{terms, position}, velocity});
  }

  double time_scale() const override { return flow_.time_scale(); }
  void add_course(TimeCourse& course) const override { flow_.add_course(course); }
  std::string describe() const override { return "the couple of the flow's shear on chains and rigid fibers"; }

 private:
  SceneFlow flow_;
  ConstScalars couple_;  ///< [n_nodes]
  NodeSums power_;
};

}  // namespace

void append_shear_couple(const SceneConfig& scene, const std::vector<Fiber>& fibers, ForceList& forces) {
  if (std::any_of(fibers.begin(), fibers.end(),
                  [](const Fiber& fiber) { return fiber.config.shear_couple > 0.0 || fiber.config.end_couple > 0.0; }))
    forces.push_back(std::make_unique<ShearCouple>(scene.flows, fibers));
}

}  // namespace skein
