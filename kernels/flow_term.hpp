#pragma once

#include <skein/core/math.hpp>
#include <skein/core/vec3.hpp>

#include <numbers>

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

/// Inside kernels and on the host. Length / time
SKEIN_INLINE_FUNCTION Vec3 velocity_of(const FlowTerm& term, const Vec3 position) {
  const Vec3 d = position - term.origin;
  switch (term.shape) {
    case FlowShape::linear:
      return {dot(term.gradient_x, d), dot(term.gradient_y, d), dot(term.gradient_z, d)};
    case FlowShape::parabolic: {
      const double height = d.y / term.size;
      return {0.5 * term.rate * term.size * (1.0 - height * height), 0.0, 0.0};
    }
    case FlowShape::cellular: {
      const double k = std::numbers::pi / term.size;
      const double speed = term.rate / k;
      return {speed * math::sin(k * d.x) * math::cos(k * d.y), -speed * math::cos(k * d.x) * math::sin(k * d.y), 0.0};
    }
  }
  return {};
}

/// What one launch adds up; it travels in the kernel's arguments.
struct FlowTerms {
  static constexpr int n_allowed = 4;
  int n_terms = 0;
  FlowTerm term[n_allowed];
};

}  // namespace skein
