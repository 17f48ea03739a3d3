#pragma once

#include "fmm/host_workers.hpp"
#include "fmm/tail_moments.hpp"

#include <algorithm>

namespace skein {

/// Moments by a host's thread: a source in each lane, lanes added at the end in their order.
template <class Real>
void add_tail_moments(const HostWorker&, const SortedNodes<HostSpace>& nodes, const IndexRange run, const Vec3 center,
                      const double half_width, const int degree, TailSource<Real>* /*tile*/, Real* moment) {
  constexpr int width = simd::width<Real>;
  const int n = n_tail_polynomials(degree);
  const HostScratch<Real> sums(3 * n * width);
  std::fill(sums.data(), sums.data() + 3 * n * width, Real(0));
  for (int first = 0; first < run.count; first += width) {
    Pack<Real> x[3] = {}, force[3] = {}, along[3][most_tail_degree + 1];
    for (int lane = 0; lane < math::smaller(width, run.count - first); ++lane) {
      const FarSource<Real> source =
          load_far_source<HostSpace, Real>(nodes, run.first + first + lane, center, 1.0 / half_width);
      for (int c = 0; c < 3; ++c) {
        x[c][lane] = source.y[c];
        force[c][lane] = source.blob_squared * source.blob_squared * source.force[c];
      }
    }
    for (int c = 0; c < 3; ++c) find_legendre<Real>(x[c], along[c]);
    Real* sum = sums.data();
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j) {
        const Pack<Real> across = along[0][i] * along[1][j];
        const Pack<Real> part[3] = {across * force[0], across * force[1], across * force[2]};
        for (int k = 0; i + j + k <= degree; ++k, sum += width)
          for (int c = 0; c < 3; ++c) {
            Real* const at = sum + c * n * width;
            simd::store_pack(at, simd::load_pack(at) + part[c] * along[2][k]);
          }
      }
  }
  for (int i = 0; i < 3 * n; ++i) {
    Real sum = 0;
    for (int lane = 0; lane < width; ++lane) sum += sums.data()[i * width + lane];
    moment[i] += sum;
  }
}

}  // namespace skein
