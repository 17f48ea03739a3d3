#pragma once

#include <skein/arrays/types.hpp>
#include <skein/core/simd.hpp>

#include "kernels/spring_force.hpp"

// The springs of a few sections of a fiber on the host, one section in each lane: every spring is weighed once, its
// rest length is the same in all lanes, and any number of nodes per section fills the lanes. What is added up are
// forces (SpringPull) or changes of them (SpringPullChange).

namespace skein {

/// Nodes of the tile's sections: node a of all of them side by side.
struct SectionTile {
  simd::Pack<double> x[max_tile_nodes], y[max_tile_nodes], z[max_tile_nodes];

  void set_to_zero(const int nodes_per_section) {
    for (int a = 0; a < nodes_per_section; ++a) x[a] = y[a] = z[a] = simd::Pack<double>{};
  }
};

/// 1/sqrt(x) to the last bits, x > 0: the series of (1 - e)^(-1/2) about the estimate y, where e = 1 - x y^2.
inline simd::Pack<double> inverse_sqrt(const simd::Pack<double> x) {
  const simd::Pack<double> y = simd::estimate_inverse_sqrt(x);
  const simd::Pack<double> e = 1.0 - x * y * y;
  return y + y * e * (0.5 + e * (0.375 + e * 0.3125));
}

/// Springs from node a of each section of `own` to the nodes first_other.. of the same lane of `other`.
struct SpringRow {
  const double* stiffness;            // [nodes_per_section], by node offset
  const double* inverse_rest_length;  // [nodes_per_section]
  int nodes_per_section;
  int a;
  int first_other;
};

/// A vector in each lane.
struct VectorPack {
  simd::Pack<double> x, y, z;
};
inline VectorPack operator-(const VectorPack& a, const VectorPack& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline simd::Pack<double> dot(const VectorPack& a, const VectorPack& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline VectorPack node_of(const SectionTile& tile, const int a) { return {tile.x[a], tile.y[a], tile.z[a]}; }

/// The force on the first node of a spring, see add_spring_force; its other node has the opposite.
struct SpringPull {
  struct Nodes {
    SectionTile position;
  };
  struct Node {
    VectorPack position;
  };
  static Node node(const Nodes& nodes, const int a) { return {node_of(nodes.position, a)}; }

  /// @param stiffness  with its factor, by lane
  static VectorPack of(const Node& own, const Node& other, const simd::Pack<double> factor, const double stiffness,
                       const double inverse_rest_length) {
    constexpr double smallest = 1e-300;  // keeps r = 0 finite; nothing else notices it
    const VectorPack d = own.position - other.position;
    const simd::Pack<double> inverse_r = inverse_sqrt(dot(d, d) + smallest);
    const simd::Pack<double> pull = factor * (stiffness * (inverse_r - inverse_rest_length));
    return {pull * d.x, pull * d.y, pull * d.z};
  }
};

/// The same of the change, see add_spring_force_change.
struct SpringPullChange {
  struct Nodes {
    SectionTile position, displacement;
  };
  struct Node {
    VectorPack position, displacement;
  };
  static Node node(const Nodes& nodes, const int a) {
    return {node_of(nodes.position, a), node_of(nodes.displacement, a)};
  }

  static VectorPack of(const Node& own, const Node& other, const simd::Pack<double> factor, const double stiffness,
                       const double inverse_rest_length) {
    constexpr double smallest = 1e-300;
    const VectorPack d = own.position - other.position, v = own.displacement - other.displacement;
    const simd::Pack<double> r_squared = dot(d, d), rest = inverse_rest_length - simd::Pack<double>{};
    // At r = 0 there is no direction, and no change.
    const simd::Pack<double> inverse_r = r_squared == 0.0 ? rest : inverse_sqrt(r_squared + smallest);
    const simd::Pack<double> stiff = factor * stiffness;
    const simd::Pack<double> across = stiff * (inverse_r - rest);
    const simd::Pack<double> along = stiff * (inverse_r * inverse_r * inverse_r) * dot(d, v);
    return {across * v.x - along * d.x, across * v.y - along * d.y, across * v.z - along * d.z};
  }
};

/// Adds what a row of springs does to both of their ends.
/// @param factor  of the stiffness, by lane; 0 where the fiber has ended
template <class Pull>
void add_row(const SpringRow& row, const simd::Pack<double> factor, const typename Pull::Nodes& own,
             const typename Pull::Nodes& other, SectionTile& force, SectionTile& reaction) {
  const int a = row.a;
  const typename Pull::Node node = Pull::node(own, a);
  VectorPack sum = {};
  for (int b = row.first_other; b < row.nodes_per_section; ++b) {
    const int node_offset = b >= a ? b - a : b - a + row.nodes_per_section;
    const double stiffness = row.stiffness[node_offset];
    if (stiffness == 0.0) continue;
    const VectorPack pull =
        Pull::of(node, Pull::node(other, b), factor, stiffness, row.inverse_rest_length[node_offset]);
    sum.x += pull.x;
    sum.y += pull.y;
    sum.z += pull.z;
    reaction.x[b] -= pull.x;
    reaction.y[b] -= pull.y;
    reaction.z[b] -= pull.z;
  }
  force.x[a] += sum.x;
  force.y[a] += sum.y;
  force.z[a] += sum.z;
}

/// Sections first_section.. of a fiber, a lane each. Lanes behind the fiber's end repeat its last section.
inline void load_tile(const ConstVectorView<HostSpace>& position, const FiberSprings& fiber, const int first_section,
                      SectionTile& tile) {
  for (int lane = 0; lane < sections_per_tile; ++lane) {
    const int section = math::smaller(first_section + lane, fiber.n_sections - 1);
    const int first = fiber.first_node + section * fiber.nodes_per_section;
    const double *x = &position(first, 0), *y = &position(first, 1), *z = &position(first, 2);
    for (int a = 0; a < fiber.nodes_per_section; ++a) {
      tile.x[a][lane] = x[a];
      tile.y[a][lane] = y[a];
      tile.z[a][lane] = z[a];
    }
  }
}

/// Puts the lanes whose section the fiber has into rows first_row + node of an array: `put` is how a row takes a value.
template <class Put>
inline void put_tile(const SectionTile& tile, const FiberSprings& fiber, const int first_section, const int first_row,
                     const VectorView<HostSpace>& force, const Put& put) {
  const int n_lanes = math::smaller(sections_per_tile, fiber.n_sections - first_section);
  for (int lane = 0; lane < n_lanes; ++lane) {
    const int first = first_row + fiber.first_node + (first_section + lane) * fiber.nodes_per_section;
    double *x = &force(first, 0), *y = &force(first, 1), *z = &force(first, 2);
    for (int a = 0; a < fiber.nodes_per_section; ++a) {
      put(x[a], tile.x[a][lane]);
      put(y[a], tile.y[a][lane]);
      put(z[a], tile.z[a][lane]);
    }
  }
}

/// Factors of the springs from the lanes' sections to those `section_offset` on; 0 where the fiber has ended.
inline simd::Pack<double> load_factors(const SpringArrays<HostSpace>& springs, const FiberSprings& fiber,
                                       const int first_section, const int section_offset) {
  simd::Pack<double> factor = {};
  for (int lane = 0; lane < sections_per_tile; ++lane) {
    const int section = first_section + lane, other = section + section_offset;
    factor[lane] = other < fiber.n_sections ? spring_factor<HostSpace>(springs, fiber, section, other) : 0.0;
  }
  return factor;
}

/// Springs inside the tile's sections and from them to later ones: what they do to the tile's own nodes into `force`,
/// to later sections into `reaction` (rows by section offset), which nobody else writes.
/// @param load  makes Pull::Nodes of a fiber's sections, from one on
template <class Pull, class Load>
void add_tile(const SpringArrays<HostSpace>& springs, const int tile, const Load& load,
              const VectorView<HostSpace>& force) {
  const FiberSprings fiber = springs.fiber(springs.fiber_of_tile(tile));
  const int first_section = (tile - fiber.first_tile) * sections_per_tile;
  const int n = fiber.nodes_per_section;
  typename Pull::Nodes own, other;
  SectionTile own_force, reaction;
  load(fiber, first_section, own);
  own_force.set_to_zero(n);

  const double* stiffness = &springs.stiffness(fiber.first_entry);
  const double* inverse_rest_length = &springs.inverse_rest_length(fiber.first_entry);
  const simd::Pack<double> inside = load_factors(springs, fiber, first_section, 0);
  for (int a = 0; a < n; ++a)
    add_row<Pull>({stiffness, inverse_rest_length, n, a, a + 1}, inside, own, own, own_force, own_force);

  for (int offset = 1; offset <= fiber.reach && first_section + offset < fiber.n_sections; ++offset) {
    stiffness += n;
    inverse_rest_length += n;
    const simd::Pack<double> factor = load_factors(springs, fiber, first_section, offset);
    load(fiber, first_section + offset, other);
    reaction.set_to_zero(n);
    for (int a = 0; a < n; ++a)
      add_row<Pull>({stiffness, inverse_rest_length, n, a, 0}, factor, own, other, own_force, reaction);
    const int n_nodes = force.extent_int(0);
    put_tile(reaction, fiber, first_section + offset, (offset - 1) * n_nodes, springs.reaction,
             [](double& row, const double value) { row = value; });
  }
  put_tile(own_force, fiber, first_section, 0, force, [](double& row, const double value) { row += value; });
}

}  // namespace skein
