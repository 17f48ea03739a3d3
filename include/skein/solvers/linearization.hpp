#pragma once

#include <skein/solvers/linear_operator.hpp>
#include <skein/solvers/step_costs.hpp>

#include <string>

namespace skein {

/// The stiff part A of d velocity / d position, for linearly implicit integrators: what is slow may be missing from it.
/// One call at a time, with arrays of the right-hand side's vectors() or with whole ones, but not both in one.
class Linearization : public LinearOperator {
 public:
  /// From now on, A is that of these positions, [n_nodes, 3], at this time.
  virtual void set_position(double time, const ConstVectors& position) = 0;

  /// Counts as one evaluation.
  void multiply(const ConstVectors& v, const Vectors& result) override = 0;

  /// Makes an approximate (I - scale A)^-1 at these positions, from them and from nothing else; it goes on to serve at
  /// other positions. @param scale  >= 0, time. @returns false where there is none
  virtual bool factorize(const ConstVectors& position, double scale) = 0;

  virtual PreconditionerCost preconditioner_cost() const = 0;

  /// One line: what the preconditioner is.
  virtual std::string describe() const = 0;
};

}  // namespace skein
