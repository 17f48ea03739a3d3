#pragma once

#include <skein/fibers/fiber.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace skein {

/// The springs of one node, alike for every node of a fiber: rest length and stiffness by section and node offset.
/// The network is not a general graph: this is what keeps the force loop free of index lists.
///
/// Entry (o, d) joins node a of section s to node (a + d) mod N_c of section s + o. Within a section d and N_c - d name
/// the same spring and hold the same values. Stiffness 0 means: no spring.
struct SpringStencil {
  int nodes_per_section = 0;
  int reach = 0;                    ///< springs join sections up to this far apart
  std::vector<double> rest_length;  ///< [reach + 1, nodes_per_section], length; that of the straight fiber
  std::vector<double> stiffness;    ///< [reach + 1, nodes_per_section], k, force

  int entry(const int section_offset, const int node_offset) const {
    return section_offset * nodes_per_section + node_offset;
  }
};

/// The springs of one fiber. Energy of a spring of length r: k l (r/l - 1)^2 / 2 with its rest length l.
struct SpringNetwork {
  int first_node = 0;
  int n_sections = 0;
  SpringStencil stencil;
  std::vector<double> section_factor;  ///< [n_sections], of the stencil's stiffness; empty: 1

  /// Of springs from a section to one `offset` further on: the mean of both.
  double factor(const int section, const int offset) const {
    return section_factor.empty() ? 1.0 : 0.5 * (section_factor[section] + section_factor[section + offset]);
  }
  int n_nodes() const { return n_sections * stencil.nodes_per_section; }
};

/// Every pair inside a section and every pair between adjacent sections, all of stiffness k, where the fiber asks for
/// nothing else (reach_along, reach_around, stiffness_profile and the factors within and between sections). None where
/// it is rigid.
SpringNetwork make_spring_network(const Fiber& fiber);
std::vector<SpringNetwork> make_spring_networks(const std::vector<Fiber>& fibers);

/// Calls visit(node, other, entry) for every spring once, sections in order; node and other index the fiber's own
/// nodes, from 0.
template <class Visit>
void for_each_spring(const SpringNetwork& network, const Visit& visit) {
  const SpringStencil& stencil = network.stencil;
  const int n = stencil.nodes_per_section;
  for (int section = 0; section < network.n_sections; ++section) {
    for (int offset = 0; offset <= stencil.reach && section + offset < network.n_sections; ++offset) {
      for (int a = 0; a < n; ++a) {
        for (int b = offset == 0 ? a + 1 : 0; b < n; ++b) {
          const int entry = stencil.entry(offset, (b - a + n) % n);
          if (stencil.stiffness[entry] > 0.0) visit(section * n + a, (section + offset) * n + b, entry);
        }
      }
    }
  }
}

std::int64_t count_springs(const SpringNetwork& network);
std::int64_t count_springs(const std::vector<SpringNetwork>& networks);
std::int64_t count_springs(const std::vector<Fiber>& fibers);

/// Both nodes of every spring, as indices into the nodes of all fibers. @returns [n_springs]
std::vector<std::array<int, 2>> make_spring_list(const std::vector<Fiber>& fibers);

/// Rest lengths of the shortest and the longest spring.
struct RestLengths {
  double shortest = 0.0, longest = 0.0;
};
RestLengths find_rest_lengths(const SpringStencil& stencil);

/// Energy of one fiber's springs, on the host; the device's is SpringForces::add_energies.
/// @param position  [network.n_nodes()], length: this fiber's nodes only
double compute_spring_energy(const SpringNetwork& network, const std::vector<Vec3>& position);

}  // namespace skein
