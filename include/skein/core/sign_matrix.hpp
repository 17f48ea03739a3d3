#pragma once

#include <skein/core/vec3.hpp>

#include <bit>
#include <vector>

namespace skein {

/// A diagonal matrix of signs, such as a reflection in a plane of the axes or a half turn about an axis: what it maps
/// is exact to the bit. Each is its own inverse, and all commute.
struct SignMatrix {
  unsigned negated = 0;  ///< bit c: component c (0: x, 1: y, 2: z) changes its sign

  SKEIN_INLINE_FUNCTION friend Vec3 operator*(const SignMatrix s, const Vec3 v) {
    return {(s.negated & 1u) != 0u ? -v.x : v.x, (s.negated & 2u) != 0u ? -v.y : v.y,
            (s.negated & 4u) != 0u ? -v.z : v.z};
  }
  SKEIN_INLINE_FUNCTION friend SignMatrix operator*(const SignMatrix a, const SignMatrix b) {
    return {a.negated ^ b.negated};
  }
  friend bool operator==(const SignMatrix&, const SignMatrix&) = default;

  /// Of what turns with a right hand, such as a torque: the image is that of a vector, times the determinant.
  Vec3 map_turning(const Vec3 v) const { return std::popcount(negated) % 2 == 0 ? *this * v : -(*this * v); }
};

/// Components that no vector can have which all these matrices keep, as bits; and a vector without them.
unsigned find_vanishing(const std::vector<SignMatrix>& matrices);
SKEIN_INLINE_FUNCTION Vec3 without_components(const unsigned vanishing, const Vec3 v) {
  return {(vanishing & 1u) != 0u ? 0.0 : v.x, (vanishing & 2u) != 0u ? 0.0 : v.y, (vanishing & 4u) != 0u ? 0.0 : v.z};
}

/// The smallest group that has these; the identity comes first.
std::vector<SignMatrix> make_group(const std::vector<SignMatrix>& generators);

}  // namespace skein
