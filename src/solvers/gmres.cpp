#include <skein/solvers/gmres.hpp>

#include <cmath>

namespace skein {

Gmres::Gmres(const int n_nodes, const int max_iterations, NodeVectors& vectors)
    : max_iterations_(max_iterations),
      n_nodes_(n_nodes),
      vectors_(vectors),
      product_(vectors.make("skein::Gmres::product", n_nodes)) {}

void Gmres::apply(LinearOperator& a, const double scale, const ConstVectors& v, const Vectors& result) {
  a.precondition(v, product_);
  a.multiply(product_, result);
  vectors_.combine(result, {{1.0, product_}, {-scale, result}});
}

Gmres::Result Gmres::solve(LinearOperator& a, const double scale, const ConstVectors& b, const Vectors& x,
                           const double tolerance) {
  const double root_n = std::sqrt(static_cast<double>(n_nodes_));
  const auto basis = [this](const int i) {
    if (static_cast<int>(basis_.size()) <= i) basis_.push_back(vectors_.make("skein::Gmres::basis", n_nodes_));
    return basis_[i];
  };
  Result result;
  // The first residual: a guess of zero needs no product.
  const Vectors first = basis(0);
  if (vectors_.dot_product(x, x) == 0.0) {
    vectors_.copy(first, b);
  } else {
    a.multiply(x, first);
    ++result.iterations;
    vectors_.combine(first, {{scale, first}, {-1.0, x}});
    vectors_.combine(first, {{1.0, first}, {1.0, b}});
  }
  const double size = std::sqrt(vectors_.dot_product(first, first));
  result.residual = size / root_n;
  if (!std::isfinite(size)) return result;
  result.converged = result.residual <= tolerance;
  column_.clear();
  cosine_.clear();
  sine_.clear();
  right_.assign(1, size);
  if (size == 0.0) return result;
  vectors_.combine(first, {{1.0 / size, first}, {0.0, first}});

  while (!result.converged && static_cast<int>(column_.size()) < max_iterations_) {
    const int k = static_cast<int>(column_.size());
    const Vectors next = basis(k + 1);
    apply(a, scale, basis(k), next);
    ++result.iterations;
    std::vector<double> column(k + 2);
    for (int i = 0; i <= k; ++i) {
      column[i] = vectors_.dot_product(basis(i), next);
      vectors_.combine(next, {{1.0, next}, {-column[i], basis(i)}});
    }
    const double length = std::sqrt(vectors_.dot_product(next, next));
    if (!std::isfinite(length)) {
      result.residual = length;
      return result;
    }
    for (int i = 0; i < k; ++i) {
      const double above = column[i];
      column[i] = cosine_[i] * above + sine_[i] * column[i + 1];
      column[i + 1] = cosine_[i] * column[i + 1] - sine_[i] * above;
    }
    const double diagonal = std::hypot(column[k], length);
    if (diagonal == 0.0) break;  // the matrix is singular
    cosine_.push_back(column[k] / diagonal);
    sine_.push_back(length / diagonal);
    column[k] = diagonal;
    column.resize(k + 1);
    column_.push_back(column);
    right_.push_back(-sine_[k] * right_[k]);
    right_[k] *= cosine_[k];
    result.residual = std::abs(right_[k + 1]) / root_n;
    result.converged = result.residual <= tolerance;
    if (length > 0.0) vectors_.combine(next, {{1.0 / length, next}, {0.0, next}});
  }
  add_solution(a, x);
  return result;
}

// x += P^-1 (combination of the basis + residual): the preconditioner is applied once in either case, and what it knows
// of the residual keeps stiff modes from drifting.
void Gmres::add_solution(LinearOperator& a, const Vectors& x) {
  const int n_columns = static_cast<int>(column_.size());
  std::vector<double> factor(n_columns + 1);
  for (int row = n_columns - 1; row >= 0; --row) {
    double sum = right_[row];
    for (int column = row + 1; column < n_columns; ++column) sum -= column_[column][row] * factor[column];
    factor[row] = sum / column_[row][row];
  }
  // The residual in the basis: the rotations undone.
  std::vector<double> residual(n_columns + 1);
  residual[n_columns] = right_[n_columns];
  for (int i = n_columns - 1; i >= 0; --i) {
    const double above = residual[i], below = residual[i + 1];
    residual[i] = cosine_[i] * above - sine_[i] * below;
    residual[i + 1] = sine_[i] * above + cosine_[i] * below;
  }
  vectors_.combine(product_, {{factor[0] + residual[0], basis_[0]}, {0.0, basis_[0]}});
  for (int i = 1; i <= n_columns; ++i)
    vectors_.combine(product_, {{1.0, product_}, {factor[i] + residual[i], basis_[i]}});
  a.precondition(product_, product_);
  vectors_.combine(x, {{1.0, x}, {1.0, product_}});
}

}  // namespace skein
