#define EIGEN_DONT_PARALLELIZE  // its blocking, and so the last bits, would depend on the number of threads

#include "kernels/section_band.hpp"

#include <skein/core/types.hpp>

#include <Eigen/Dense>

#include <algorithm>

namespace skein {
namespace {

using Block = Eigen::Map<Eigen::MatrixXd>;
using ConstBlock = Eigen::Map<const Eigen::MatrixXd>;
using Column = Eigen::Map<Eigen::VectorXd>;

}  // namespace

SectionBand::SectionBand(const int n_sections, const int block_size, const int half_width)
    : n_sections_(n_sections),
      block_size_(block_size),
      half_width_(std::min(half_width, n_sections - 1)),
      value_(static_cast<std::size_t>(n_sections) * (2 * half_width_ + 1) * block_size * block_size) {}

void SectionBand::set_to_zero() { std::fill(value_.begin(), value_.end(), 0.0); }

bool SectionBand::factorize() {
  const int size = block_size_;
  for (int s = 0; s < n_sections_; ++s) {
    const Block pivot(block(s, s), size, size);
    Block diagonal(block(s, s), size, size);
    diagonal = Eigen::PartialPivLU<Eigen::MatrixXd>(pivot).inverse().eval();
    if (!diagonal.allFinite()) return false;
    const int last = std::min(s + half_width_, n_sections_ - 1);
    Kokkos::parallel_for("skein::SectionBand::factorize", Kokkos::RangePolicy<HostSpace>(HostSpace(), s + 1, last + 1),
                         [=, this](const int row) {
                           Block below(block(row, s), size, size);
                           below = (below * ConstBlock(block(s, s), size, size)).eval();
                           for (int column = s + 1; column <= last; ++column) {
                             Block target(block(row, column), size, size);
                             target.noalias() -= below * ConstBlock(block(s, column), size, size);
                           }
                         });
    HostSpace().fence();
  }
  return true;
}

void SectionBand::solve(double* x) const {
  const int size = block_size_;
  const auto part = [=](const int section) { return Column(x + static_cast<std::size_t>(section) * size, size); };
  for (int row = 1; row < n_sections_; ++row) {
    Column target = part(row);
    for (int s = std::max(0, row - half_width_); s < row; ++s)
      target.noalias() -= ConstBlock(block(row, s), size, size) * part(s);
  }
  for (int row = n_sections_ - 1; row >= 0; --row) {
    Column target = part(row);
    for (int s = std::min(row + half_width_, n_sections_ - 1); s > row; --s)
      target.noalias() -= ConstBlock(block(row, s), size, size) * part(s);
    target = (ConstBlock(block(row, row), size, size) * target).eval();
  }
}

}  // namespace skein
