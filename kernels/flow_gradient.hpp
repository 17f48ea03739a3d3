#pragma once

#include <skein/core/math.hpp>

#include "kernels/flow_term.hpp"

#include <numbers>

namespace skein {

// Gradients of the flows of flow_velocity.hpp, inside kernels and on the host.

/// Gradient of each component of a velocity, 1 / time: row i, entry j is d u_i / d x_j.
struct GradientRows {
  Vec3 x, y, z;

  /// Gradient of the velocity's component along a direction that stays: G^T direction.
  SKEIN_INLINE_FUNCTION Vec3 of_component(const Vec3 direction) const {
    return direction.x * x + direction.y * y + direction.z * z;
  }

  /// (G + G^T) direction: twice the rate of strain, applied to a direction.
  SKEIN_INLINE_FUNCTION Vec3 twice_strain(const Vec3 direction) const {
    return of_component(direction) + Vec3{dot(x, direction), dot(y, direction), dot(z, direction)};
  }
};

SKEIN_INLINE_FUNCTION GradientRows gradient_of(const FlowTerm& term, const Vec3 position) {
  const Vec3 d = position - term.origin;
  GradientRows rows;
  switch (term.shape) {
    case FlowShape::linear:
      rows = {term.gradient_x, term.gradient_y, term.gradient_z};
      break;
    case FlowShape::parabolic:
      rows.x.y = -term.rate * d.y / term.size;
      break;
    case FlowShape::cellular: {
      const double k = std::numbers::pi / term.size;
      const double along = term.rate * math::cos(k * d.x) * math::cos(k * d.y);
      const double across = term.rate * math::sin(k * d.x) * math::sin(k * d.y);
      rows.x = {along, -across, 0.0};
      rows.y = {across, -along, 0.0};
      break;
    }
  }
  return rows;
}

/// First-order change of that gradient where the position moves by `displacement`, length.
SKEIN_INLINE_FUNCTION GradientRows gradient_change_of(const FlowTerm& term, const Vec3 position,
                                                      const Vec3 displacement) {
  GradientRows rows;
  if (term.shape == FlowShape::parabolic) rows.x.y = -term.rate * displacement.y / term.size;
  if (term.shape == FlowShape::cellular) {
    const Vec3 d = position - term.origin;
    const double k = std::numbers::pi / term.size;
    const double sin_x = math::sin(k * d.x), cos_x = math::cos(k * d.x);
    const double sin_y = math::sin(k * d.y), cos_y = math::cos(k * d.y);
    const double turn_x = k * displacement.x, turn_y = k * displacement.y;
    const double along = -term.rate * (sin_x * cos_y * turn_x + cos_x * sin_y * turn_y);
    const double across = term.rate * (cos_x * sin_y * turn_x + sin_x * cos_y * turn_y);
    rows.x = {along, -across, 0.0};
    rows.y = {across, -along, 0.0};
  }
  return rows;
}

}  // namespace skein
