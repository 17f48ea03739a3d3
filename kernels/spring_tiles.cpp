#include "kernels/spring_tiles.hpp"

#include <skein/arrays/launch.hpp>

#include "kernels/spring_tile.hpp"

namespace skein {
namespace {

/// The tile of a node's section, or of the first one whose springs reach it.
int tile_of(const SpringArrays<HostSpace>& springs, const int node, const bool looks_back) {
  const FiberSprings fiber = springs.fiber(springs.fiber_of_node(node));
  const int section = (node - fiber.first_node) / fiber.nodes_per_section;
  return fiber.first_tile + math::larger(0, section - (looks_back ? fiber.reach : 0)) / sections_per_tile;
}

/// @param cost  of a node's springs, for `launch`
template <class Pull, class Load>
void add_by_tiles(const char* name, const HostSpace& space, const SpringArrays<HostSpace>& springs,
                  const IndexRange nodes, const double cost, const Load& load, const VectorView<HostSpace>& force) {
  const int n_nodes = force.extent_int(0);
  const double per_tile = cost * n_nodes / math::larger(1, springs.fiber_of_tile.extent_int(0));
  // Tiles whose springs reach forward to these nodes are among them.
  const int first_tile = tile_of(springs, nodes.first, true);
  const int n_tiles = tile_of(springs, nodes.first + nodes.count - 1, false) + 1 - first_tile;
  launch<HostSpace>(name, space, Calls{n_tiles, per_tile},
                    [=](const int i) { add_tile<Pull>(springs, first_tile + i, load, force); });

  const int n_reactions = springs.reaction.extent_int(0);
  launch<HostSpace>("skein::add_spring_reaction", space, Calls{nodes.count, 3.0}, [=](const int i) {
    const int node = nodes.first + i;
    for (int row = node; row < n_reactions; row += n_nodes)
      store(force, node, skein::load(force, node) + skein::load(springs.reaction, row));
  });
}

}  // namespace

void add_spring_force_by_tiles(const HostSpace& space, const SpringArrays<HostSpace>& springs, const IndexRange nodes,
                               const ConstVectorView<HostSpace>& position, const VectorView<HostSpace>& force) {
  const auto load = [=](const FiberSprings& fiber, const int first_section, SpringPull::Nodes& tile) {
    load_tile(position, fiber, first_section, tile.position);
  };
  add_by_tiles<SpringPull>("skein::add_spring_force", space, springs, nodes, 25.0, load, force);
}

void add_spring_force_change_by_tiles(const HostSpace& space, const SpringArrays<HostSpace>& springs,
                                      const IndexRange nodes, const ConstVectorView<HostSpace>& position,
                                      const ConstVectorView<HostSpace>& displacement,
                                      const VectorView<HostSpace>& change) {
  const auto load = [=](const FiberSprings& fiber, const int first_section, SpringPullChange::Nodes& tile) {
    load_tile(position, fiber, first_section, tile.position);
    load_tile(displacement, fiber, first_section, tile.displacement);
  };
  add_by_tiles<SpringPullChange>("skein::add_spring_force_change", space, springs, nodes, 40.0, load, change);
}

}  // namespace skein
