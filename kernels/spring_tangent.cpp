#include "kernels/spring_tangent.hpp"

#include <skein/arrays/launch.hpp>
#include <skein/core/error.hpp>

#include "kernels/spring_node.hpp"
#include "kernels/spring_tiles.hpp"

namespace skein {
namespace {

template <class Space>
KOKKOS_INLINE_FUNCTION Vec3 change_on_node(const SpringArrays<Space>& springs, const ConstVectorView<Space>& position,
                                           const ConstVectorView<Space>& displacement, const int node) {
  const Vec3 x = load(position, node), u = load(displacement, node);
  Vec3 change;
  for_each_spring<Space>(springs, node, [&](const int other, const double stiffness, const double inverse_rest_length) {
    const Vec3 d = x - load(position, other);
    const double r_squared = dot(d, d);
    if (r_squared == 0.0) return;
    const double inverse_r = math::inverse_sqrt(r_squared);
    const Vec3 v = u - load(displacement, other);
    change = change + stiffness * (inverse_r - inverse_rest_length) * v;
    change = change - stiffness * inverse_r * inverse_r * inverse_r * dot(d, v) * d;
  });
  return change;
}

}  // namespace

template <class Space>
void add_spring_force_change(const Space& space, const SpringArrays<Space>& springs, const IndexRange nodes,
                             const ConstVectorView<Space>& position, const ConstVectorView<Space>& displacement,
                             const VectorView<Space>& change) {
  SKEIN_REQUIRE(position.extent(0) == springs.fiber_of_node.extent(0) && displacement.extent(0) == position.extent(0) &&
                    change.extent(0) == position.extent(0),
                "positions, displacements, changes and the nodes of the springs differ in number");
  if (nodes.count == 0) return;
  if constexpr (on_host<Space>)
    if (!springs.has_wide_sections)
      return add_spring_force_change_by_tiles(space, springs, nodes, position, displacement, change);
  launch<Space>(
      "skein::add_spring_force_change_by_nodes", space, Calls{nodes.count, 100.0}, KOKKOS_LAMBDA(const int i) {
        const int node = nodes.first + i;
        store(change, node, load(change, node) + change_on_node<Space>(springs, position, displacement, node));
      });
}

#define SKEIN_INSTANTIATE(S)                                                                                        \
  template void add_spring_force_change<S>(const S&, const SpringArrays<S>&, IndexRange, const ConstVectorView<S>&, \
                                           const ConstVectorView<S>&, const VectorView<S>&);
SKEIN_FOR_EACH_EXEC_SPACE(SKEIN_INSTANTIATE)

}  // namespace skein
