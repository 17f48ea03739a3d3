#pragma once

#include "fmm/laplace.hpp"

// What the blobs add to the field beyond the doublet: the term of eps^4, which no harmonic potential has. It falls as
// r^-5, so that it matters between near boxes only, and there to some per cent. Boxes carry it as moments of their
// forces with Legendre polynomials, and as coefficients of such polynomials for the velocities of their targets.

namespace skein {

/// (eps^4 / 8) [grad grad . - Laplacian] r^-3 f: the next term of the regularized Stokeslet after those of
/// HarmonicField, as the passes know a far field. Columns of coefficients: [3][polynomial].
struct TailField {
  static constexpr int n_planes = 3;
  static constexpr int n_columns = 1;
  static constexpr bool shifts = false;
  int degree = 0;  ///< of the polynomials, 1 .. most_tail_degree
  SKEIN_INLINE_FUNCTION TailField at(double /*half_width*/) const { return *this; }

  template <class Lanes, class Real>
  SKEIN_FORMULA void add_source(const Lanes x, const Lanes y, const Lanes z, const FarSource<Real>& source,
                                Lanes (&potential)[n_planes]) const {
    const Real strength = source.blob_squared * source.blob_squared;
    const Real force[3] = {strength * source.force[0], strength * source.force[1], strength * source.force[2]};
    add_density(x, y, z, source.y, force, potential);
  }

  template <class Lanes, class Real>
  SKEIN_FORMULA void add_density(const Lanes x, const Lanes y, const Lanes z, const Real (&point)[3],
                                 const Real (&q)[n_planes], Lanes (&u)[3]) const {
    const Lanes dx = x - point[0], dy = y - point[1], dz = z - point[2];
    const Lanes inverse = math::inverse_sqrt(dx * dx + (dy * dy + dz * dz));
    const Lanes inverse_squared = inverse * inverse;
    const Lanes inverse_fifth = inverse_squared * inverse_squared * inverse;
    const Lanes isotropic = Real(-1.125) * inverse_fifth;
    const Lanes along = Real(1.875) * (q[0] * dx + (q[1] * dy + q[2] * dz)) * inverse_squared * inverse_fifth;
    u[0] += isotropic * q[0];
    u[0] += along * dx;
    u[1] += isotropic * q[1];
    u[1] += along * dy;
    u[2] += isotropic * q[2];
    u[2] += along * dz;
  }
};

inline constexpr int most_tail_degree = 8;

/// Polynomials P_i(x) P_j(y) P_k(z) with i + j + k <= degree, k fastest, then j.
SKEIN_INLINE_FUNCTION constexpr int n_tail_polynomials(const int degree) {
  return (degree + 1) * (degree + 2) * (degree + 3) / 6;
}

/// P_0 .. P_most of Legendre at x, by their recurrence.
template <class Real, class Lanes>
SKEIN_FORMULA void find_legendre(const Lanes x, Lanes (&value)[most_tail_degree + 1]) {
  value[0] = Real(1) + (x - x);  // no constant of packs, which the device's compiler refuses
  value[1] = x;
  SKEIN_UNROLL
  for (int n = 1; n < most_tail_degree; ++n)
    value[n + 1] = (Real(2 * n + 1) / Real(n + 1)) * x * value[n] - (Real(n) / Real(n + 1)) * value[n - 1];
}

/// u += velocity of the coefficients of a box at a place in its units.
/// @param coefficient  [3][n_tail_polynomials(degree)]
template <class Real, class Lanes>
SKEIN_FORMULA void add_tail_velocity(const int degree, const Real* coefficient, const Lanes (&x)[3], Lanes (&u)[3]) {
  const int n = n_tail_polynomials(degree);
  Lanes along[3][most_tail_degree + 1];
  for (int c = 0; c < 3; ++c) find_legendre<Real>(x[c], along[c]);
  int place = 0;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j) {
      const Lanes across = along[0][i] * along[1][j];
      Lanes sum[3];
      for (int c = 0; c < 3; ++c) sum[c] = coefficient[c * n + place] * along[2][0];
      ++place;
      for (int k = 1; i + j + k <= degree; ++k, ++place)
        for (int c = 0; c < 3; ++c) sum[c] += coefficient[c * n + place] * along[2][k];
      for (int c = 0; c < 3; ++c) u[c] += across * sum[c];
    }
}

}  // namespace skein
