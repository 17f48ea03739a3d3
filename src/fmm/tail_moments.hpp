#pragma once

#include "fmm/blob_tail.hpp"
#include "fmm/box_passes.hpp"

#include <cstddef>

// How the passes begin with the tails of the blobs: moments of the sources of leaves in the place of potentials.

namespace skein {

inline constexpr int tail_tile = 16;  ///< sources whose polynomials a team keeps at once

/// Polynomials along each axis at a source, and its force times (eps / half-width)^4.
template <class Real>
struct TailSource {
  Real along[3][most_tail_degree + 1];
  Real force[3];
};

template <class Real>
SKEIN_FORMULA void load_tail_source(const FarSource<Real>& from, TailSource<Real>& to) {
  for (int c = 0; c < 3; ++c) {
    find_legendre<Real>(from.y[c], to.along[c]);
    to.force[c] = from.blob_squared * from.blob_squared * from.force[c];
  }
}

/// moment[c][polynomial] += sum of (eps / half-width)^4 force_c times the polynomials at some sources. A thread takes
/// the polynomials of one row, P_i P_j P_0, P_i P_j P_1 and so on, and one component; sources are added in their order.
/// A host has packs instead: tail_packs.hpp.
/// @param tile    [tail_tile], of the worker
/// @param moment  [3][n_tail_polynomials(degree)]
template <class Worker, class Space, class Real>
SKEIN_FORMULA void add_tail_moments(const Worker& worker, const SortedNodes<Space>& nodes, const IndexRange run,
                                    const Vec3 center, const double half_width, const int degree,
                                    TailSource<Real>* tile, Real* moment) {
  const int n = n_tail_polynomials(degree), n_rows = (degree + 1) * (degree + 2) / 2;
  for (int first = 0; first < run.count; first += tail_tile) {
    const int count = math::smaller(tail_tile, run.count - first);
    worker.barrier();  // the tile may be overwritten
    for (int s = worker.rank(); s < count; s += worker.size())
      load_tail_source(load_far_source<Space, Real>(nodes, run.first + first + s, center, 1.0 / half_width), tile[s]);
    worker.barrier();  // the tile is complete
    for (int task = worker.rank(); task < 3 * n_rows; task += worker.size()) {
      const int c = task / n_rows;
      int i = 0, j = task % n_rows, place = 0;  // the row's polynomials begin at `place`
      for (; j > degree - i; ++i) {
        place += (degree - i + 1) * (degree - i + 2) / 2;
        j -= degree - i + 1;
      }
      for (int before = 0; before < j; ++before) place += degree - i - before + 1;
      Real sum[most_tail_degree + 1] = {};
      for (int s = 0; s < count; ++s) {
        const Real across = tile[s].along[0][i] * tile[s].along[1][j] * tile[s].force[c];
        for (int k = 0; k <= most_tail_degree; ++k) sum[k] += across * tile[s].along[2][k];
      }
      for (int k = 0; k <= degree - i - j; ++k) moment[c * n + place + k] += sum[k];
    }
  }
}

/// Sources of leaves to their moments (P2M); zero for other boxes.
template <class Space, class Real>
struct SourcesToMoments {
  Passes<Space, Real, TailField> passes;

  template <class Workers>
  std::size_t scratch_bytes() const {
    return Workers::template array_bytes<TailSource<Real>>(tail_tile);
  }
  template <class Worker>
  SKEIN_FORMULA void operator()(const Worker& worker, const IndexRange boxes) const {
    const auto tile = worker.template array<TailSource<Real>>(tail_tile);
    for (int b = boxes.first; b < boxes.first + boxes.count; ++b) {
      const Box& box = passes.boxes(b);
      Real* const moment = passes.source_of(b);
      fill_zeros(worker, moment, passes.coefficients.box_size);
      if (!box.is_leaf() || box.sources.count == 0) continue;
      add_tail_moments(worker, passes.nodes, box.sources, passes.cube.center(box), passes.cube.half_width(box.level),
                       passes.field.degree, tile.data(), moment);
    }
  }
};

}  // namespace skein
