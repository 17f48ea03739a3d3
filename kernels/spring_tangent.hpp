#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/spring_force.hpp"

namespace skein {

/// Adds to change, [n_nodes, 3], at some nodes, the first-order change of the springs' forces when nodes move by
/// `displacement`: dF/dx v, symmetric, and negative semidefinite up to the springs' own compression. One spring on a
/// node, with v the node's displacement less the other's:
///
///   change = k (1/r - 1/l) v - k (d . v) d / r^3;   zero at r = 0
///
/// The order of every sum is fixed. Changes at other nodes near these are left in any state.
template <class Space>
void add_spring_force_change(const Space& space, const SpringArrays<Space>& springs, IndexRange nodes,
                             const ConstVectorView<Space>& position, const ConstVectorView<Space>& displacement,
                             const VectorView<Space>& change);

}  // namespace skein
