#pragma once

#include <cstddef>
#include <vector>

namespace skein {

/// A square matrix of dense blocks, a block row for each section of a fiber, zero beyond half_width blocks from the
/// diagonal; on the host. Its LU factors take its place. Results do not depend on the number of threads.
class SectionBand {
 public:
  SectionBand(int n_sections, int block_size, int half_width);

  int n_sections() const { return n_sections_; }
  int block_size() const { return block_size_; }
  int half_width() const { return half_width_; }

  /// [block_size, block_size], columns contiguous. @param column  within half_width of row
  double* block(int row, int column) { return &value_[offset(row, column)]; }
  const double* block(int row, int column) const { return &value_[offset(row, column)]; }
  void set_to_zero();

  /// Blocks are eliminated in order, without exchanging rows of different blocks: for matrices like I + c M K, whose
  /// diagonal blocks stay regular.
  /// @returns false where a block was singular or not finite: the factors are of no use then
  bool factorize();

  /// Overwrites the right-hand side x, [n_sections * block_size], with the solution.
  void solve(double* x) const;

 private:
  std::size_t offset(int row, int column) const {
    return (static_cast<std::size_t>(row) * (2 * half_width_ + 1) + (column - row + half_width_)) * block_size_ *
           block_size_;
  }

  int n_sections_, block_size_, half_width_;
  std::vector<double> value_;
};

}  // namespace skein
