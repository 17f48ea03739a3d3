#include <skein/fibers/node_orbits.hpp>
#include <skein/physics/flow_summary.hpp>
#include <skein/physics/symmetry_check.hpp>
#include <skein/scene/words.hpp>

#include "physics/flow_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

namespace skein {
namespace {

constexpr double alike_share = 1e-10;  // what differs by less of itself is taken for the same

std::string describe_vector(const Vec3 v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x, v.y, v.z); }

bool are_same(const Vec3 a, const Vec3 b, const double scale) { return norm(a - b) <= alike_share * scale; }

// Polynomials and waves that are alike at this many points without any order are alike everywhere.
std::vector<Vec3> list_sample_points(const double reach) {
  constexpr int n_points = 16;
  const auto spread = [reach](const double share) { return reach * (2.0 * (share - std::floor(share)) - 1.0); };
  std::vector<Vec3> points;
  for (int i = 1; i <= n_points; ++i) points.push_back({spread(0.7549 * i), spread(0.5698 * i), spread(0.4302 * i)});
  return points;
}

auto course_of(const FlowConfig& flow) {
  return std::make_tuple(flow.angular_frequency, flow.phase, flow.start, flow.stop, flow.ramp);
}

/// Flows that change alike are judged together, at their full rates: the sum of some may have a symmetry that none has.
std::string find_flow_fault(const std::vector<FlowConfig>& flows, const SignMatrix matrix, const double reach) {
  const std::vector<Vec3> points = list_sample_points(reach);
  for (const FlowConfig& lead : flows) {
    double speed = 0.0;
    std::vector<Vec3> difference(points.size());
    for (const FlowConfig& flow : flows) {
      const FlowRow& row = row_of(flow.kind);
      if (row.is_at_rest() || course_of(flow) != course_of(lead)) continue;
      const FlowTerm term = row.make_term(flow, flow.rate);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 here = velocity_of(term, points[i]);
        speed = std::max(speed, norm(here));
        difference[i] = difference[i] + velocity_of(term, matrix * points[i]) - matrix * here;
      }
    }
    for (const Vec3 d : difference)
      if (!are_same(d, {}, speed))
        return fmt::format("the flow, {}, is not mapped onto itself: center it on the plane or axis",
                           summarize_flow(flows).description);
  }
  return {};
}

/// Where a node is.
struct Section {
  int fiber = 0, section = 0;
};

Section find_section(const std::vector<Fiber>& fibers, const int node) {
  const Fiber& fiber = find_fiber_of(fibers, node);
  return {fiber.index, (node - fiber.first_node) / fiber.config.nodes_per_section};
}

/// What acts on sections must act on their images as its image does, as often.
/// @param is_image  of a matrix and two loads: true if the second is what the first is mapped onto, sections aside
template <class Load, class IsImage>
std::string find_load_fault(const char* table, const std::vector<Load>& loads, const std::vector<Fiber>& fibers,
                            const NodeMap& map, const SignMatrix matrix, const IsImage& is_image) {
  const auto section_of = [&](const Load& load) {
    const int n = fibers[static_cast<std::size_t>(load.fiber)].config.sections;
    return load.section < 0 ? load.section + n : load.section;
  };
  const auto count_images = [&](const Load& load, const Section& where, const SignMatrix under) {
    return std::count_if(loads.begin(), loads.end(), [&](const Load& other) {
      return other.fiber == where.fiber && section_of(other) == where.section && is_image(under, load, other);
    });
  };
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const Section here{loads[i].fiber, section_of(loads[i])};
    const Fiber& fiber = fibers[static_cast<std::size_t>(here.fiber)];
    const int node = fiber.first_node + here.section * fiber.config.nodes_per_section;
    const Section image = find_section(fibers, map.image[static_cast<std::size_t>(node)]);
    if (count_images(loads[i], image, matrix) < count_images(loads[i], here, SignMatrix{}))
      return fmt::format(
          "{0}[{1}] acts on section {2} of fiber {3}, and no {0} that is its image on section {4} of "
          "fiber {5}: add one",
          table, i, here.section, here.fiber, image.section, image.fiber);
  }
  return {};
}

std::string find_tether_fault(const SceneConfig& scene, const std::vector<Fiber>& fibers, const NodeMap& map,
                              const SignMatrix matrix, const double reach) {
  return find_load_fault("tether", scene.tethers, fibers, map, matrix,
                         [&](const SignMatrix under, const TetherConfig& one, const TetherConfig& other) {
                           return one.stiffness == other.stiffness &&
                                  one.angular_frequency == other.angular_frequency &&
                                  are_same(under * one.point, other.point, norm(one.point) + reach) &&
                                  are_same(under * one.velocity, other.velocity, norm(one.velocity)) &&
                                  are_same(under * one.swing, other.swing, norm(one.swing));
                         });
}

std::string find_torque_fault(const SceneConfig& scene, const std::vector<Fiber>& fibers, const NodeMap& map,
                              const SignMatrix matrix) {
  return find_load_fault("torque", scene.torques, fibers, map, matrix,
                         [&](const SignMatrix under, const TorqueConfig& one, const TorqueConfig& other) {
                           return are_same(under.map_turning(one.torque), other.torque, norm(one.torque)) &&
                                  are_same(under.map_turning(one.angular_velocity), other.angular_velocity,
                                           norm(one.angular_velocity));
                         });
}

std::string find_gravity_fault(const GravityConfig& gravity, const SignMatrix matrix) {
  if (gravity.weight == 0.0 || are_same(matrix * gravity.direction, gravity.direction, norm(gravity.direction)))
    return {};
  return fmt::format("gravity pulls towards {}, out of the plane or across the axis: turn the scene, or gravity",
                     describe_vector(gravity.direction));
}

// Which waves map onto each other depends on planes that turn with the fibers.
std::string find_undulation_fault(const SceneConfig& scene) {
  const bool has_helix =
      std::any_of(scene.fibers.begin(), scene.fibers.end(), [](const FiberConfig& fiber) { return fiber.is_helix(); });
  if (has_helix) return "a fiber is a helix at rest, which symmetry does not know yet: take a straight one";
  return scene.undulations.empty() ? "" : "fibers undulate, which symmetry does not know yet: leave it out";
}

// Frames hold nodes one by one, whose images a roll may put anywhere.
std::string find_clamp_fault(const SceneConfig& scene) {
  return scene.clamps.empty() ? "" : "clamps hold sections, which symmetry does not know yet: take [[tether]]s";
}

/// Nodes of the start, and how far they reach from the origin.
struct Start {
  std::vector<Fiber> fibers;
  std::vector<Vec3> nodes;
  double reach = 0.0;
};

std::string find_fault(const SceneConfig& scene, const Start& start, const SignMatrix matrix) {
  const NodeMap map = find_node_map(start.fibers, start.nodes, matrix);
  if (!map.fault.empty())
    return map.fault + ": move, turn or roll the fiber, or give it another number of sections or nodes on a section";
  for (const std::string& fault :
       {find_flow_fault(scene.flows, matrix, start.reach), find_gravity_fault(scene.gravity, matrix),
        find_tether_fault(scene, start.fibers, map, matrix, start.reach),
        find_torque_fault(scene, start.fibers, map, matrix), find_undulation_fault(scene), find_clamp_fault(scene)})
    if (!fault.empty()) return fault;
  return {};
}

}  // namespace

std::vector<KeyProblem> find_symmetry_problems(const SceneConfig& scene) {
  if (scene.symmetry.is_none()) return {};
  Start start{make_fibers(scene.fibers), {}, 0.0};
  start.nodes = make_surface_nodes(start.fibers, scene.seed);
  for (const Vec3 node : start.nodes) start.reach = std::max(start.reach, norm(node));
  std::vector<KeyProblem> problems;
  const auto check = [&](const std::string& key, const SymmetryAxis axis, const SignMatrix matrix) {
    if (axis == SymmetryAxis::none) return;
    const std::string fault = find_fault(scene, start, matrix);
    if (!fault.empty())
      problems.push_back({key, fmt::format("{} = \"{}\" is not a symmetry of the scene: {}; or leave the key out", key,
                                           word_of(axis), fault)});
  };
  check("symmetry.mirror", scene.symmetry.mirror, make_mirror(scene.symmetry.mirror));
  check("symmetry.half_turn", scene.symmetry.half_turn, make_half_turn(scene.symmetry.half_turn));
  return problems;
}

}  // namespace skein
