#include "plain_loop.hpp"

#include <cmath>

namespace {

template <class Real>
void sum_all(const int n, const Real* const x, const Real* const f, const Real blob, const Real viscosity,
             Real* const velocity) {
  const Real* const y = x + n;
  const Real* const z = y + n;
  const Real* const fy = f + n;
  const Real* const fz = fy + n;
  const Real blob_squared = blob * blob;
  const Real scale = Real(1) / (Real(8) * Real(3.14159265358979323846) * viscosity);
#pragma omp parallel for schedule(static)
  for (int i = 0; i < n; ++i) {
    Real ux = 0, uy = 0, uz = 0;
#pragma omp simd reduction(+ : ux, uy, uz)
    for (int j = 0; j < n; ++j) {
      const Real dx = x[i] - x[j];
      const Real dy = y[i] - y[j];
      const Real dz = z[i] - z[j];
      const Real core_squared = dx * dx + dy * dy + dz * dz + blob_squared;
      const Real inverse = Real(1) / std::sqrt(core_squared);
      const Real cubed = inverse * inverse * inverse;
      const Real isotropic = cubed * (core_squared + blob_squared);
      const Real along = cubed * (f[j] * dx + fy[j] * dy + fz[j] * dz);
      ux += isotropic * f[j] + along * dx;
      uy += isotropic * fy[j] + along * dy;
      uz += isotropic * fz[j] + along * dz;
    }
    velocity[i] = scale * ux;
    velocity[n + i] = scale * uy;
    velocity[2 * n + i] = scale * uz;
  }
}

}  // namespace

void plain_loop(const int n, const double* position, const double* force, const double blob, const double viscosity,
                double* velocity) {
  sum_all(n, position, force, blob, viscosity, velocity);
}
void plain_loop(const int n, const float* position, const float* force, const float blob, const float viscosity,
                float* velocity) {
  sum_all(n, position, force, blob, viscosity, velocity);
}
