#pragma once

#include "fmm/fmm_translations.hpp"
#include "fmm/host_scratch.hpp"

// Potentials of nodes on the surface of a box.

namespace skein {

using simd::Pack;

inline constexpr int potential_tile = 128;  // sources whose units are changed at once

template <class Real>
void load_far_sources(const SortedNodes& nodes, const int first, const int count, const Vec3 center,
                      const double half_width, FarSource<Real>* sources) {
  const double to_units = 1.0 / half_width;
  for (int s = 0; s < count; ++s) {
    const int i = first + s;
    const Vec3 y = to_units * (load(nodes.position, i) - center);
    const double blob = to_units * nodes.blob(i);
    sources[s] = {{static_cast<Real>(y.x), static_cast<Real>(y.y), static_cast<Real>(y.z)},
                  {static_cast<Real>(nodes.force(i, 0)), static_cast<Real>(nodes.force(i, 1)),
                   static_cast<Real>(nodes.force(i, 2))},
                  static_cast<Real>(blob * blob)};
  }
}

/// potential[plane][n_padded] += field of some sources at the surface of that size; packs of points in registers.
template <int packs, class Real, class Field>
void add_potentials(const Field& field, const OperatorSet<Real>& operators, const Real size, const int first,
                    const FarSource<Real>* sources, const int n_sources, Real* potential) {
  constexpr int width = simd::width<Real>;
  Pack<Real> x[packs][3], sum[packs][Field::n_planes] = {};
  for (int k = 0; k < packs; ++k)
    for (int c = 0; c < 3; ++c) x[k][c] = size * simd::load_pack(&operators.surface(first + k * width, c));
  for (int s = 0; s < n_sources; ++s) SKEIN_UNROLL
  for (int k = 0; k < packs; ++k) field.add_source(x[k][0], x[k][1], x[k][2], sources[s], sum[k]);
  for (int k = 0; k < packs; ++k)
    for (int plane = 0; plane < Field::n_planes; ++plane) {
      Real* const at = potential + plane * operators.n_padded + first + k * width;
      simd::store_pack(at, simd::load_pack(at) + sum[k][plane]);
    }
}

template <class Real, class Field>
void add_run_potentials(const SortedNodes& nodes, const IndexRange run, const Vec3 center, const double half_width,
                        const Field& field, const OperatorSet<Real>& operators, const double size, Real* potential) {
  constexpr int width = simd::width<Real>;
  FarSource<Real> sources[potential_tile];
  for (int first = 0; first < run.count; first += potential_tile) {
    const int count = math::smaller(potential_tile, run.count - first);
    load_far_sources(nodes, run.first + first, count, center, half_width, sources);
    int i = 0;
    for (; i + 2 * width <= operators.n_padded; i += 2 * width)
      add_potentials<2>(field, operators, static_cast<Real>(size), i, sources, count, potential);
    for (; i < operators.n_padded; i += width)
      add_potentials<1>(field, operators, static_cast<Real>(size), i, sources, count, potential);
  }
}

}  // namespace skein
