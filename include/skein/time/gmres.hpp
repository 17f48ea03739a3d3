#pragma once

#include <skein/time/linearization.hpp>

#include <vector>

namespace skein {

/// Solves (I - scale A) x = b, preconditioned from the left, by GMRES without restarts and with dot products in a fixed
/// order. Source: Saad, Schultz, SIAM J. Sci. Stat. Comput. 7, 856 (1986).
class Gmres {
 public:
  Gmres(int n_nodes, int max_iterations);

  struct Result {
    int iterations = 0;
    double residual = 0.0;  ///< root mean square of the preconditioned residual, not finite where a product was not
    bool converged = false;
  };

  /// @param x          the first guess, overwritten with the solution as far as it came
  /// @param tolerance  of the preconditioned residual's root mean square, unit of b; each iteration is one product
  Result solve(Linearization& a, double scale, const ConstVectors& b, const Vectors& x, double tolerance);

 private:
  /// result = (approximately (I - scale A)^-1) (I - scale A) v
  void apply(Linearization& a, double scale, const ConstVectors& v, const Vectors& result);
  void add_combination(const Vectors& x, int n_columns);

  int max_iterations_;
  std::vector<Vectors> basis_;               ///< [max_iterations + 1], made when they are needed
  std::vector<std::vector<double>> column_;  ///< of the triangular matrix
  std::vector<double> cosine_, sine_, right_;
  int n_nodes_;
  Vectors product_;
};

}  // namespace skein
