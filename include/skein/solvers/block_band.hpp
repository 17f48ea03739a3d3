#pragma once

#include <cstddef>
#include <vector>

namespace skein {

/// A square matrix of dense blocks, a block row for each section of a fiber, zero beyond half_width blocks from the
/// diagonal; on the host. Sections are eliminated from both ends at once, and those in the middle, as many as the half
/// width, last: two threads share the work. The LU factors are made in double precision and kept in single, because a
/// solution is a pass through memory. Results do not depend on the number of threads.
class BlockBand {
 public:
  BlockBand(int n_rows, int block_size, int half_width);

  int n_rows() const { return n_rows_; }
  int block_size() const { return block_size_; }
  int half_width() const { return half_width_; }

  /// Begins a new matrix.
  void set_to_zero();

  /// [block_size, block_size], columns contiguous; of the matrix, until it is factorized.
  /// @param column  within half_width of row
  double* block(int row, int column) { return &value_[offset(row, column) * block_size_]; }

  /// Blocks are eliminated in order, without exchanging rows of different blocks: for matrices like I + c M K, whose
  /// diagonal blocks stay regular.
  /// @returns false where a block was singular or not finite: the factors are of no use then
  bool factorize();

  /// Overwrites the right-hand side x, [n_rows * block_size], with the solution, up to the rounding of the factors.
  void solve(double* x) const;

 private:
  /// One of the two ends, by its order of elimination: sections first, first + step, ... , n_rows of them.
  struct End {
    int first, step, n_rows;
  };
  /// Columns of blocks before this block's.
  std::size_t offset(int row, int column) const {
    return (static_cast<std::size_t>(row) * (2 * half_width_ + 1) + (column - row + half_width_)) * block_size_;
  }
  const float* factor(int row, int column) const { return &factor_[offset(row, column) * stride_]; }
  bool is_in_middle(int section) const { return section >= middle_begin_ && section < middle_end_; }

  bool invert_pivot(int section);
  /// Eliminates section s from a row; what the lower end does to the middle waits in of_lower_.
  void eliminate(int s, int row, int step);
  void round_factors();
  void solve_end(const End& end, bool is_forward, double* x) const;
  void solve_middle(double* x) const;

  int n_rows_, block_size_, half_width_;
  int stride_;  ///< of the factors' columns: whole vectors
  int middle_begin_, middle_end_;
  End end_[2];
  std::vector<double> value_, of_lower_;
  std::vector<float> factor_;  ///< columns padded with zeros
};

}  // namespace skein
