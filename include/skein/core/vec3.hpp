#pragma once

#include <skein/core/math.hpp>

namespace skein {

/// A vector of three reals. Separations are always target - source.
struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;

  SKEIN_INLINE_FUNCTION friend Vec3 operator+(const Vec3 a, const Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  SKEIN_INLINE_FUNCTION friend Vec3 operator-(const Vec3 a, const Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  SKEIN_INLINE_FUNCTION friend Vec3 operator-(const Vec3 a) { return {-a.x, -a.y, -a.z}; }
  SKEIN_INLINE_FUNCTION friend Vec3 operator*(const double s, const Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  SKEIN_INLINE_FUNCTION friend Vec3 operator/(const Vec3 a, const double s) { return {a.x / s, a.y / s, a.z / s}; }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

SKEIN_INLINE_FUNCTION double dot(const Vec3 a, const Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
SKEIN_INLINE_FUNCTION Vec3 cross(const Vec3 a, const Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
SKEIN_INLINE_FUNCTION double norm(const Vec3 a) { return math::sqrt(dot(a, a)); }

}  // namespace skein
