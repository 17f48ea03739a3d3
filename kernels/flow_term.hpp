#pragma once

#include <skein/core/vec3.hpp>

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

}  // namespace skein
