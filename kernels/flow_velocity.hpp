#pragma once

#include <skein/arrays/types.hpp>

#include <array>

namespace skein {

enum class FlowShape { linear, parabolic, cellular };

/// A flow at one moment; d = position - origin.
struct FlowTerm {
  FlowShape shape = FlowShape::linear;
  Vec3 origin;                              ///< length
  Vec3 gradient_x, gradient_y, gradient_z;  ///< linear: velocity component = gradient . d, 1 / time
  double rate = 0.0;                        ///< parabolic, cellular: 1 / time
  double size = 1.0;                        ///< parabolic, cellular: length
};

/// What one launch adds up; it travels in the kernel's arguments.
struct FlowTerms {
  static constexpr int n_allowed = 4;
  int n_terms = 0;
  FlowTerm term[n_allowed];
};

/// Gradients of the three components of a velocity, 1 / time.
using FlowGradient = std::array<Vec3, 3>;

/// velocity += the sum of the terms at each position.
///   linear     (gradient_x . d, gradient_y . d, gradient_z . d)
///   parabolic  (rate size/2 (1 - (d.y/size)^2), 0, 0)
///   cellular   rate/k (sin(k d.x) cos(k d.y), -cos(k d.x) sin(k d.y), 0), k = pi/size
/// @param position, velocity  [n, 3], length and length / time
template <class Space>
void add_flow_velocity(const Space& space, const FlowTerms& terms, const ConstVectorView<Space>& position,
                       const VectorView<Space>& velocity);

/// Of the same velocity, on the host.
FlowGradient compute_flow_gradient(const FlowTerm& term, Vec3 position);

}  // namespace skein
