#pragma once

#include "fmm/laplace.hpp"
#include "fmm/level_operators.hpp"
#include "fmm/sorted_nodes.hpp"

// The innermost loops of the passes, for lanes of either kind: numbers of a device's thread, or packs of a host's. What
// is read of a source or of a density serves all the lanes that are held.

namespace skein {

inline constexpr int source_tile = 128;  ///< sources whose units are changed at once

template <class Space, class Real>
SKEIN_FORMULA FarSource<Real> load_far_source(const SortedNodes<Space>& nodes, const int i, const Vec3 center,
                                              const double to_units) {
  const Vec3 y = to_units * (load(nodes.position, i) - center);
  const double blob = to_units * nodes.blob(i);
  return {{static_cast<Real>(y.x), static_cast<Real>(y.y), static_cast<Real>(y.z)},
          {static_cast<Real>(nodes.force(i, 0)), static_cast<Real>(nodes.force(i, 1)),
           static_cast<Real>(nodes.force(i, 2))},
          static_cast<Real>(blob * blob)};
}

/// sum += potentials of sources at the held points.
template <int n_held, class Lane, class Real, class Field>
SKEIN_FORMULA void add_sources(const Field& field, const FarSource<Real>* sources, const int count,
                               const Lane (&x)[n_held][3], Lane (&sum)[n_held][Field::n_planes]) {
  for (int s = 0; s < count; ++s) {
    const FarSource<Real> source = sources[s];
    SKEIN_UNROLL
    for (int k = 0; k < n_held; ++k) field.add_source(x[k][0], x[k][1], x[k][2], source, sum[k]);
  }
}

/// u += velocities at the held targets of the densities on a surface.
template <int n_held, class Lane, class Real, class Field>
SKEIN_FORMULA void add_densities(const Field& field, const LevelOperators<Real>& operators, const Real size,
                                 const Real* density, const IndexRange points, const Lane (&x)[n_held][3],
                                 Lane (&u)[n_held][3]) {
  for (int j = points.first; j < points.first + points.count; ++j) {
    Real point[3], q[Field::n_planes];
    for (int c = 0; c < 3; ++c) point[c] = size * operators.surface_at(j, c);
    for (int plane = 0; plane < Field::n_planes; ++plane) q[plane] = density[plane * operators.n_padded + j];
    SKEIN_UNROLL
    for (int k = 0; k < n_held; ++k) field.add_density(x[k][0], x[k][1], x[k][2], point, q, u[k]);
  }
}

/// A row of coefficients, or a pack of rows, with the sign of a reflection. The fourth column of a field that shifts
/// (psi, measured from the box's centre) is moved to the centre of the other box: scale * psi + shift . phi.
template <class Field, class Lanes, class Real>
SKEIN_FORMULA void move_row(const Lanes sign, const Real scale, const Real (&shift)[3],
                            Lanes (&row)[Field::n_columns]) {
  if constexpr (Field::shifts) row[3] = scale * row[3] + shift[0] * row[0] + shift[1] * row[1] + shift[2] * row[2];
  for (int column = 0; column < Field::n_columns; ++column) row[column] = sign * row[column];
}

/// The same for one row in memory.
template <class Field, class Real>
SKEIN_FORMULA void gather_row(const Real* from, const int stride, const Real sign, const Real scale,
                              const Real (&shift)[3], Real* to, const int to_stride) {
  Real row[Field::n_columns];
  for (int column = 0; column < Field::n_columns; ++column) row[column] = from[column * stride];
  move_row<Field>(sign, scale, shift, row);
  for (int column = 0; column < Field::n_columns; ++column) to[column * to_stride] = row[column];
}

}  // namespace skein
