#include <skein/fibers/fiber_kinds.hpp>
#include <skein/fibers/node_orbits.hpp>
#include <skein/fibers/spring_network.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <limits>

namespace skein {
namespace {

/// How the sections of a fiber are mapped onto those of another, and the nodes of each: node a onto start +- a.
struct FiberMap {
  int fiber = -1;
  bool is_reversed = false;   ///< the first section onto the last
  int start = 0;              ///< the node that node 0 of a section is mapped onto
  bool turns_around = false;  ///< nodes follow each other the other way around
};

std::string describe_point(const Vec3 x) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", x.x, x.y, x.z); }

/// True where springs of both are as stiff, section by section.
bool are_alike(const Fiber& one, const Fiber& other, const bool is_reversed) {
  FiberConfig same_profile = put_in_place_of(one.config, other.config);
  same_profile.stiffness_profile = other.config.stiffness_profile;
  if (!(same_profile == other.config)) return false;
  const auto a = make_spring_network(one), b = make_spring_network(other);
  constexpr double rounding = 1e-12;
  for (int section = 0; section < a.n_sections; ++section)
    if (std::abs(a.factor(section, 0) - b.factor(is_reversed ? a.n_sections - 1 - section : section, 0)) > rounding)
      return false;
  return true;
}

/// Maps one fiber after the other.
class Mapper {
 public:
  Mapper(const std::vector<Fiber>& fibers, const std::vector<Vec3>& nodes, const SignMatrix matrix)
      : fibers_(fibers), nodes_(nodes), matrix_(matrix) {
    for (const Fiber& fiber : fibers) centre_.push_back(mean_of(fiber));
  }

  NodeMap make() const {
    NodeMap map;
    map.image.resize(nodes_.size());
    for (const Fiber& fiber : fibers_) {
      const FiberMap found = find_map(fiber);
      if (found.fiber < 0) return {{}, describe_fault(fiber)};
      for (int node = 0; node < fiber.n_nodes(); ++node)
        map.image[static_cast<std::size_t>(fiber.first_node) + static_cast<std::size_t>(node)] =
            image_of(fiber, found, node);
    }
    return map;
  }

 private:
  Vec3 mean_of(const Fiber& fiber) const {
    Vec3 sum;
    for (int node = 0; node < fiber.n_nodes(); ++node) sum = sum + at(fiber.first_node + node);
    return sum / static_cast<double>(fiber.n_nodes());
  }
  const Vec3& at(const int node) const { return nodes_[static_cast<std::size_t>(node)]; }

  int image_of(const Fiber& fiber, const FiberMap& map, const int node) const {
    const int n = fiber.config.nodes_per_section, section = node / n, a = node % n;
    const int image = map.is_reversed ? fiber.config.sections - 1 - section : section;
    const int b = (map.turns_around ? map.start - a + n : map.start + a) % n;
    return fibers_[static_cast<std::size_t>(map.fiber)].first_node + image * n + b;
  }

  double distance(const int node, const int image) const { return norm(matrix_ * at(node) - at(image)); }

  /// @returns the first node of the fiber that is not mapped onto where another stands; -1: all are
  int find_stray(const Fiber& fiber, const FiberMap& map) const {
    for (int node = 0; node < fiber.n_nodes(); ++node)
      if (!(distance(fiber.first_node + node, image_of(fiber, map, node)) <= partner_tolerance * fiber.spacing()))
        return node;
    return -1;
  }

  /// Of all ways to map the fiber onto another that which goes farthest before a node is stray.
  struct BestMap {
    FiberMap map;
    int first_stray = 0;  ///< -1: none
  };
  BestMap find_best(const Fiber& fiber) const {
    BestMap best;
    const auto index = static_cast<std::size_t>(fiber.index);
    const int n = fiber.config.nodes_per_section;
    for (const Fiber& other : fibers_) {
      const Vec3 apart = matrix_ * centre_[index] - centre_[static_cast<std::size_t>(other.index)];
      if (other.n_nodes() != fiber.n_nodes() || !(norm(apart) <= partner_tolerance * fiber.spacing())) continue;
      for (const bool is_reversed : {false, true})
        for (const bool turns_around : {false, true})
          for (int start = 0; start < n; ++start) {
            const FiberMap map{other.index, is_reversed, start, turns_around};
            if (!(distance(fiber.first_node, image_of(fiber, map, 0)) <= partner_tolerance * fiber.spacing())) continue;
            if (!are_alike(fiber, other, is_reversed)) continue;
            const int stray = find_stray(fiber, map);
            if (stray < 0) return {map, stray};
            if (best.map.fiber < 0 || stray > best.first_stray) best = {map, stray};
          }
    }
    return best;
  }

  FiberMap find_map(const Fiber& fiber) const {
    const BestMap best = find_best(fiber);
    return best.first_stray < 0 ? best.map : FiberMap{};
  }

  std::string describe_fault(const Fiber& fiber) const {
    const BestMap best = find_best(fiber);
    const int stray = best.first_stray, n = fiber.config.nodes_per_section;
    return fmt::format("node {} of section {} of fiber {}, at {}, has no partner at {} on a fiber that is alike",
                       stray % n, stray / n, fiber.index, describe_point(at(fiber.first_node + stray)),
                       describe_point(matrix_ * at(fiber.first_node + stray)));
  }

  const std::vector<Fiber>& fibers_;
  const std::vector<Vec3>& nodes_;
  SignMatrix matrix_;
  std::vector<Vec3> centre_;  ///< [n_fibers]
};

}  // namespace

NodeMap find_node_map(const std::vector<Fiber>& fibers, const std::vector<Vec3>& nodes, const SignMatrix matrix) {
  return Mapper(fibers, nodes, matrix).make();
}

}  // namespace skein
