#include <skein/arrays/types.hpp>
#include <skein/core/simd.hpp>
#include <skein/solvers/block_band.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cstring>

namespace skein {
namespace {

using Block = Eigen::Map<Eigen::MatrixXd>;
using ConstBlock = Eigen::Map<const Eigen::MatrixXd>;

constexpr int lanes = simd::width<double>;
constexpr int packs_at_once = 8;  // of a column, in registers

/// y -= A x for some rows, `n_packs` packs of them, of which the last may be partly padding.
template <int n_packs>
void subtract_rows(const float* a, const int stride, const double* x, double* y, const int n_rows,
                   const int n_columns) {
  simd::Pack<double> sum[n_packs] = {};
  for (int column = 0; column < n_columns; ++column) {
    const float* const from = a + static_cast<std::ptrdiff_t>(column) * stride;
    const simd::Pack<double> factor = x[column] - simd::Pack<double>{};
    SKEIN_UNROLL
    for (int i = 0; i < n_packs; ++i) {
      simd::HalfPack half;
      std::memcpy(&half, from + i * lanes, sizeof half);
      sum[i] += simd::to_double(half) * factor;
    }
  }
  double result[n_packs * lanes];
  std::memcpy(result, sum, sizeof result);
  for (int i = 0; i < n_rows; ++i) y[i] -= result[i];
}

/// The same for as many packs as the rows fill, of n_packs at most.
template <int n_packs>
void subtract_filled_rows(const float* a, const int stride, const double* x, double* y, const int n_rows,
                          const int n_columns) {
  if constexpr (n_packs > 1)
    if (n_rows <= (n_packs - 1) * lanes) return subtract_filled_rows<n_packs - 1>(a, stride, x, y, n_rows, n_columns);
  subtract_rows<n_packs>(a, stride, x, y, n_rows, n_columns);
}

/// y -= A x, A with columns of `stride` floats.
void subtract_product(const float* a, const int stride, const double* x, double* y, const int size) {
  for (int row = 0; row < size; row += packs_at_once * lanes)
    subtract_filled_rows<packs_at_once>(a + row, stride, x, y + row, std::min(size - row, packs_at_once * lanes), size);
}

/// x = A x.
void multiply_in_place(const float* a, const int stride, double* x, const int size) {
  std::vector<double> result(size, 0.0);
  subtract_product(a, stride, x, result.data(), size);
  for (int i = 0; i < size; ++i) x[i] = -result[i];
}

}  // namespace

BlockBand::BlockBand(const int n_rows, const int block_size, const int half_width)
    : n_rows_(n_rows),
      block_size_(block_size),
      half_width_(std::min(half_width, n_rows - 1)),
      stride_((block_size + lanes - 1) / lanes * lanes) {
  middle_begin_ = (n_rows_ - half_width_) / 2;
  middle_end_ = middle_begin_ + half_width_;
  end_[0] = {0, 1, middle_begin_};
  end_[1] = {n_rows_ - 1, -1, n_rows_ - middle_end_};
}

void BlockBand::set_to_zero() {
  const std::size_t block = static_cast<std::size_t>(block_size_) * block_size_;
  value_.assign(n_rows_ * (2 * half_width_ + 1) * block, 0.0);
  of_lower_.assign(half_width_ * half_width_ * block, 0.0);
}

bool BlockBand::invert_pivot(const int section) {
  const Block pivot(block(section, section), block_size_, block_size_);
  const Eigen::MatrixXd inverse = Eigen::PartialPivLU<Eigen::MatrixXd>(pivot).inverse();
  Block(block(section, section), block_size_, block_size_) = inverse;
  return inverse.allFinite();
}

void BlockBand::eliminate(const int s, const int row, const int step) {
  const int size = block_size_;
  Block here(block(row, s), size, size);
  here = (here * ConstBlock(block(s, s), size, size)).eval();
  for (int i = 1; i <= half_width_; ++i) {
    const int column = s + i * step;
    // From the middle onwards sections end where the middle does.
    if (column < 0 || column >= n_rows_ || (is_in_middle(s) && column >= middle_end_)) break;
    const bool waits = step < 0 && is_in_middle(row) && is_in_middle(column);
    double* const place =
        waits ? &of_lower_[(static_cast<std::size_t>(row - middle_begin_) * half_width_ + (column - middle_begin_)) *
                           size * size]
              : block(row, column);
    Block(place, size, size).noalias() -= here * ConstBlock(block(s, column), size, size);
  }
}

bool BlockBand::factorize() {
  using Range = Kokkos::RangePolicy<HostSpace>;
  const std::size_t size = static_cast<std::size_t>(block_size_) * block_size_;
  int is_regular[2] = {1, 1};
  // Both ends in step, each step's rows at once.
  for (int k = 0; k < std::max(end_[0].n_rows, end_[1].n_rows); ++k) {
    Kokkos::parallel_for("skein::BlockBand::invert_pivot", Range(HostSpace(), 0, 2), [&](const int e) {
      if (k < end_[e].n_rows && !invert_pivot(end_[e].first + k * end_[e].step)) is_regular[e] = 0;
    });
    HostSpace().fence();
    if (is_regular[0] == 0 || is_regular[1] == 0) return false;
    Kokkos::parallel_for("skein::BlockBand::eliminate", Range(HostSpace(), 0, 2 * half_width_), [&](const int item) {
      const End& end = end_[item % 2];
      const int s = end.first + k * end.step, row = s + (item / 2 + 1) * end.step;
      if (k < end.n_rows && row >= 0 && row < n_rows_) eliminate(s, row, end.step);
    });
    HostSpace().fence();
  }
  for (int row = middle_begin_; row < middle_end_; ++row)
    for (int column = middle_begin_; column < middle_end_; ++column) {
      const double* from =
          &of_lower_[(static_cast<std::size_t>(row - middle_begin_) * half_width_ + (column - middle_begin_)) * size];
      double* to = block(row, column);
      for (std::size_t i = 0; i < size; ++i) to[i] += from[i];
    }
  for (int s = middle_begin_; s < middle_end_; ++s) {
    if (!invert_pivot(s)) return false;
    Kokkos::parallel_for("skein::BlockBand::eliminate_middle", Range(HostSpace(), s + 1, middle_end_),
                         [&](const int row) { eliminate(s, row, 1); });
    HostSpace().fence();
  }
  round_factors();
  std::vector<double>().swap(value_);
  std::vector<double>().swap(of_lower_);
  return true;
}

void BlockBand::round_factors() {
  const std::size_t n_columns = value_.size() / block_size_;
  factor_.assign(n_columns * stride_, 0.0f);
  for (std::size_t column = 0; column < n_columns; ++column)
    for (int i = 0; i < block_size_; ++i)
      factor_[column * stride_ + i] = static_cast<float>(value_[column * block_size_ + i]);
}

void BlockBand::solve_end(const End& end, const bool is_forward, double* x) const {
  const int size = block_size_;
  for (int k = 0; k < end.n_rows; ++k) {
    const int row = end.first + (is_forward ? k : end.n_rows - 1 - k) * end.step;
    double* const target = x + static_cast<std::ptrdiff_t>(row) * size;
    // Forward: what was eliminated before this section; backward: what comes after it, the middle included.
    const int direction = is_forward ? -end.step : end.step;
    for (int i = half_width_; i > 0; --i) {
      const int s = row + i * direction;
      if (s >= 0 && s < n_rows_)
        subtract_product(factor(row, s), stride_, x + static_cast<std::ptrdiff_t>(s) * size, target, size);
    }
    if (!is_forward) multiply_in_place(factor(row, row), stride_, target, size);
  }
}

void BlockBand::solve_middle(double* x) const {
  const int size = block_size_;
  const auto part = [=](const int section) { return x + static_cast<std::ptrdiff_t>(section) * size; };
  const auto subtract = [&](const int row, const int s) {
    subtract_product(factor(row, s), stride_, part(s), part(row), size);
  };
  for (int row = middle_begin_; row < middle_end_; ++row) {
    for (int s = std::max(0, row - half_width_); s < row; ++s) subtract(row, s);
    for (int s = middle_end_; s <= std::min(n_rows_ - 1, row + half_width_); ++s) subtract(row, s);
  }
  for (int row = middle_end_ - 1; row >= middle_begin_; --row) {
    for (int s = middle_end_ - 1; s > row; --s) subtract(row, s);
    multiply_in_place(factor(row, row), stride_, part(row), size);
  }
}

void BlockBand::solve(double* x) const {
  const auto both_ends = [&](const bool is_forward) {
    Kokkos::parallel_for("skein::BlockBand::solve", Kokkos::RangePolicy<HostSpace>(HostSpace(), 0, 2),
                         [&](const int e) { solve_end(end_[e], is_forward, x); });
    HostSpace().fence();
  };
  both_ends(true);
  solve_middle(x);
  both_ends(false);
}

}  // namespace skein
