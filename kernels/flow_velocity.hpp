#pragma once

#include <skein/arrays/types.hpp>

#include "kernels/flow_term.hpp"

namespace skein {

/// velocity += the sum of the terms at each position.
///   linear     (gradient_x . d, gradient_y . d, gradient_z . d)
///   parabolic  (rate size/2 (1 - (d.y/size)^2), 0, 0)
///   cellular   rate/k (sin(k d.x) cos(k d.y), -cos(k d.x) sin(k d.y), 0), k = pi/size
/// @param position, velocity  [n, 3], length and length / time
template <class Space>
void add_flow_velocity(const Space& space, const FlowTerms& terms, const ConstVectorView<Space>& position,
                       const VectorView<Space>& velocity);

/// The same in place of what was in `velocity`.
template <class Space>
void compute_flow_velocity(const Space& space, const FlowTerms& terms, const ConstVectorView<Space>& position,
                           const VectorView<Space>& velocity);

}  // namespace skein
