#pragma once

#include "kernels/regularized_stokeslet.hpp"

#include <cstdint>

namespace skein {

namespace math {

/// x^(-1/2) to a few units of the last place, x > 0: the series of (1 - e)^(-1/2) about the estimate y, e = 1 - x y^2.
inline simd::Pack<double> inverse_sqrt(const simd::Pack<double> x) {
  const simd::Pack<double> y = simd::estimate_inverse_sqrt(x);
  const simd::Pack<double> e = 1.0 - x * y * y;
  return y + y * e * (0.5 + e * (0.375 + e * 0.3125));
}
inline simd::Pack<float> inverse_sqrt(const simd::Pack<float> x) {
  const simd::Pack<float> y = simd::estimate_inverse_sqrt(x);
  const simd::Pack<float> e = 1.0f - x * y * y;
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  return y + 0.5f * y * e;  // |e| < 1.3e-4: the next term is below 7e-9
#else
  return y + y * e * (0.5f + e * 0.375f);
#endif
}

}  // namespace math

/// One source as the far field sees it, in units of a box's half-width and from its centre.
template <class Real>
struct FarSource {
  Real y[3], force[3];
  Real blob_squared;
};

// The far fields. Each writes `n_planes` potentials at check points and reads as many densities at equivalent points;
// planes are grouped in `n_columns` columns that share one translation operator. Lanes: check points or targets.

/// The regularized Stokeslet to O(eps^4 / r^5) by four harmonic potentials (d = x - y):
///
///   u_i = phi_i - x_k d_i phi_k + d_i psi,   phi = sum f / r,   psi = sum (y . f) / r + (eps^2 / 2) (f . d) / r^3
struct HarmonicField {
  static constexpr int n_planes = 4;
  static constexpr int n_columns = 4;
  static constexpr bool shifts = true;  ///< psi is measured from the box's centre
  SKEIN_INLINE_FUNCTION HarmonicField at(double /*half_width*/) const { return *this; }

  template <class Lanes, class Real>
  SKEIN_FORMULA void add_source(const Lanes x, const Lanes y, const Lanes z, const FarSource<Real>& source,
                                Lanes (&potential)[n_planes]) const {
    const Lanes dx = x - source.y[0], dy = y - source.y[1], dz = z - source.y[2];
    const Lanes inverse = math::inverse_sqrt(dx * dx + (dy * dy + dz * dz));
    const Real y_dot_f = source.y[0] * source.force[0] + source.y[1] * source.force[1] + source.y[2] * source.force[2];
    const Lanes f_dot_d = source.force[0] * dx + source.force[1] * dy + source.force[2] * dz;
    const Real half_blob_squared = Real(0.5) * source.blob_squared;
    potential[0] += source.force[0] * inverse;
    potential[1] += source.force[1] * inverse;
    potential[2] += source.force[2] * inverse;
    potential[3] += (y_dot_f + half_blob_squared * f_dot_d * inverse * inverse) * inverse;
  }

  /// u += q / r + s grad(1 / r), s = q_psi - x . q, of the densities at the equivalent point y.
  template <class Lanes, class Real>
  SKEIN_FORMULA void add_density(const Lanes x, const Lanes y, const Lanes z, const Real (&point)[3],
                                 const Real (&q)[n_planes], Lanes (&u)[3]) const {
    const Lanes dx = x - point[0], dy = y - point[1], dz = z - point[2];
    const Lanes inverse = math::inverse_sqrt(dx * dx + (dy * dy + dz * dz));
    const Lanes s = (x * q[0] + (y * q[1] + z * q[2]) - q[3]) * inverse * inverse * inverse;
    u[0] += q[0] * inverse;
    u[0] += s * dx;
    u[1] += q[1] * inverse;
    u[1] += s * dy;
    u[2] += q[2] * inverse;
    u[2] += s * dz;
  }
};

/// Equivalent strengths of the singular Stokeslet S_0; the sources' field at the check points is that of the blobs, or
/// only its part that solves the Stokes equations, S_0 + (eps^2 / 4) Laplacian S_0.
struct StokesletField {
  static constexpr int n_planes = 3;
  static constexpr int n_columns = 1;
  static constexpr bool shifts = false;
  bool stokes_part_only = false;
  SKEIN_INLINE_FUNCTION StokesletField at(double /*half_width*/) const { return *this; }

  template <class Lanes, class Real>
  SKEIN_FORMULA void add_source(const Lanes x, const Lanes y, const Lanes z, const FarSource<Real>& source,
                                Lanes (&potential)[n_planes]) const {
    const Lanes dx = x - source.y[0], dy = y - source.y[1], dz = z - source.y[2];
    if (!stokes_part_only) {
      const auto weight = regularized_stokeslet::weights(dx, dy, dz, source.blob_squared);
      regularized_stokeslet::add(weight, dx, dy, dz, source.force[0], source.force[1], source.force[2], potential[0],
                                 potential[1], potential[2]);
      return;
    }
    const Lanes inverse = math::inverse_sqrt(dx * dx + (dy * dy + dz * dz));
    const Lanes inverse_squared = inverse * inverse;
    const Lanes f_dot_d = source.force[0] * dx + source.force[1] * dy + source.force[2] * dz;
    const Lanes doublet = Real(0.5) * source.blob_squared * inverse_squared;
    const Lanes isotropic = inverse + doublet * inverse;
    const Lanes along = (inverse - Real(3) * doublet * inverse) * inverse_squared * f_dot_d;
    potential[0] += isotropic * source.force[0];
    potential[0] += along * dx;
    potential[1] += isotropic * source.force[1];
    potential[1] += along * dy;
    potential[2] += isotropic * source.force[2];
    potential[2] += along * dz;
  }

  template <class Lanes, class Real>
  SKEIN_FORMULA void add_density(const Lanes x, const Lanes y, const Lanes z, const Real (&point)[3],
                                 const Real (&q)[n_planes], Lanes (&u)[3]) const {
    const Lanes dx = x - point[0], dy = y - point[1], dz = z - point[2];
    const Lanes inverse = math::inverse_sqrt(dx * dx + (dy * dy + dz * dz));
    const Lanes along = (q[0] * dx + q[1] * dy + q[2] * dz) * inverse * inverse * inverse;
    u[0] += q[0] * inverse;
    u[0] += along * dx;
    u[1] += q[1] * inverse;
    u[1] += along * dy;
    u[2] += q[2] * inverse;
    u[2] += along * dz;
  }
};

/// The regularized Stokeslet in every operator; one blob for all. Depends on eps / half-width: operators per level.
struct RegularizedField {
  static constexpr int n_planes = 3;
  static constexpr int n_columns = 1;
  static constexpr bool shifts = false;
  double blob_squared = 0.0;  ///< length^2; in units of a box after at()
  SKEIN_INLINE_FUNCTION RegularizedField at(const double half_width) const {
    return {blob_squared / (half_width * half_width)};
  }

  template <class Lanes, class Real>
  SKEIN_FORMULA void add_source(const Lanes x, const Lanes y, const Lanes z, const FarSource<Real>& source,
                                Lanes (&potential)[n_planes]) const {
    const Lanes dx = x - source.y[0], dy = y - source.y[1], dz = z - source.y[2];
    const auto weight = regularized_stokeslet::weights(dx, dy, dz, source.blob_squared);
    regularized_stokeslet::add(weight, dx, dy, dz, source.force[0], source.force[1], source.force[2], potential[0],
                               potential[1], potential[2]);
  }

  template <class Lanes, class Real>
  SKEIN_FORMULA void add_density(const Lanes x, const Lanes y, const Lanes z, const Real (&point)[3],
                                 const Real (&q)[n_planes], Lanes (&u)[3]) const {
    const Lanes dx = x - point[0], dy = y - point[1], dz = z - point[2];
    const auto weight = regularized_stokeslet::weights(dx, dy, dz, static_cast<Real>(blob_squared));
    regularized_stokeslet::add(weight, dx, dy, dz, q[0], q[1], q[2], u[0], u[1], u[2]);
  }
};

}  // namespace skein
