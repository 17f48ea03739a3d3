#include <skein/core/error.hpp>
#include <skein/fibers/spring_network.hpp>
#include <skein/scene/profile.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace skein {
namespace {

/// From the formula, not from placed nodes: the same for every position and direction of the fiber.
SpringStencil make_stencil(const FiberConfig& config, const double spacing) {
  SpringStencil stencil;
  stencil.nodes_per_section = config.nodes_per_section;
  stencil.reach = config.reach_along;
  for (int offset = 0; offset <= stencil.reach; ++offset) {
    for (int node = 0; node < config.nodes_per_section; ++node) {
      // The shorter way round, so that d and N_c - d agree to the last bit.
      const int steps = std::min(node, config.nodes_per_section - node);
      const double chord = 2.0 * config.radius * std::sin(std::numbers::pi * steps / config.nodes_per_section);
      const bool is_itself = offset == 0 && node == 0;
      const bool is_joined = !config.is_rigid() && (config.reach_around == 0 || steps <= config.reach_around);
      const double factor = offset == 0 ? config.stiffness_within_sections : config.stiffness_between_sections;
      stencil.rest_length.push_back(std::hypot(offset * spacing, chord));
      stencil.stiffness.push_back(is_itself || !is_joined ? 0.0 : factor * config.spring_stiffness);
    }
  }
  return stencil;
}

std::vector<double> make_section_factors(const FiberConfig& config) {
  SKEIN_REQUIRE(!config.stiffness_profile.empty(), "a profile of stiffness has points");
  std::vector<double> factors;
  for (int section = 0; section < config.sections; ++section)
    factors.push_back(interpolate(config.stiffness_profile, section / (config.sections - 1.0)));
  return factors;
}

}  // namespace

SpringNetwork make_spring_network(const Fiber& fiber) {
  return {fiber.first_node, fiber.config.sections, make_stencil(fiber.config, fiber.spacing()),
          make_section_factors(fiber.config)};
}

std::vector<SpringNetwork> make_spring_networks(const std::vector<Fiber>& fibers) {
  std::vector<SpringNetwork> networks;
  for (const Fiber& fiber : fibers) networks.push_back(make_spring_network(fiber));
  return networks;
}

std::int64_t count_springs(const SpringNetwork& network) {
  std::int64_t n_springs = 0;
  for_each_spring(network, [&](int, int, int) { ++n_springs; });
  return n_springs;
}

std::int64_t count_springs(const std::vector<SpringNetwork>& networks) {
  std::int64_t n_springs = 0;
  for (const SpringNetwork& network : networks) n_springs += count_springs(network);
  return n_springs;
}

std::int64_t count_springs(const std::vector<Fiber>& fibers) { return count_springs(make_spring_networks(fibers)); }

std::vector<std::array<int, 2>> make_spring_list(const std::vector<Fiber>& fibers) {
  std::vector<std::array<int, 2>> springs;
  for (const Fiber& fiber : fibers) {
    for_each_spring(make_spring_network(fiber), [&](const int node, const int other, int) {
      springs.push_back({fiber.first_node + node, fiber.first_node + other});
    });
  }
  return springs;
}

RestLengths find_rest_lengths(const SpringStencil& stencil) {
  RestLengths found{std::numeric_limits<double>::infinity(), 0.0};
  for (std::size_t entry = 0; entry < stencil.rest_length.size(); ++entry) {
    if (stencil.stiffness[entry] == 0.0) continue;
    found.shortest = std::min(found.shortest, stencil.rest_length[entry]);
    found.longest = std::max(found.longest, stencil.rest_length[entry]);
  }
  return found;
}

double compute_spring_energy(const SpringNetwork& network, const std::vector<Vec3>& position) {
  SKEIN_REQUIRE(static_cast<int>(position.size()) == network.n_nodes(), "positions are those of the network's nodes");
  double energy = 0.0;
  for_each_spring(network, [&](const int node, const int other, const int entry) {
    const double rest_length = network.stencil.rest_length[entry];
    const double strain = norm(position[node] - position[other]) / rest_length - 1.0;
    const int nodes_per_section = network.stencil.nodes_per_section;
    const int section = node / nodes_per_section;
    const double stiffness =
        network.factor(section, other / nodes_per_section - section) * network.stencil.stiffness[entry];
    energy += 0.5 * stiffness * rest_length * strain * strain;
  });
  return energy;
}

}  // namespace skein
