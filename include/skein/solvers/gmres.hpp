#pragma once

#include <skein/arrays/node_vectors.hpp>
#include <skein/solvers/linear_operator.hpp>

#include <vector>

namespace skein {

/// Solves (I - scale A) x = b, preconditioned from the right, by GMRES without restarts and with dot products in a
/// fixed order. The residual judged is that of the equation itself: with 18 nodes on a section, the preconditioner
/// hides residuals of a ring's breathing by up to a factor of 600, and steps would go on from what is no solution.
/// Source: Saad, Schultz, SIAM J. Sci. Stat. Comput. 7, 856 (1986).
class Gmres {
 public:
  /// @param vectors  what it works with, and what `solve` is given was made by; must outlive the object
  Gmres(int n_nodes, int max_iterations, NodeVectors& vectors = whole_vectors());

  struct Result {
    int iterations = 0;
    double residual = 0.0;  ///< root mean square of the equation's residual, not finite where a product was not
    bool converged = false;
  };

  /// @param x          the first guess, overwritten with the solution as far as it came
  /// @param tolerance  of the residual's root mean square, unit of b; each iteration is one product
  Result solve(LinearOperator& a, double scale, const ConstVectors& b, const Vectors& x, double tolerance);

 private:
  /// result = (I - scale A) (approximately (I - scale A)^-1) v; product_ is the inverse's product
  void apply(LinearOperator& a, double scale, const ConstVectors& v, const Vectors& result);
  void add_solution(LinearOperator& a, const Vectors& x);

  int max_iterations_;
  std::vector<Vectors> basis_;               ///< [max_iterations + 1], made when they are needed
  std::vector<std::vector<double>> column_;  ///< of the triangular matrix
  std::vector<double> cosine_, sine_, right_;
  int n_nodes_;
  NodeVectors& vectors_;
  Vectors product_;
};

}  // namespace skein
