#pragma once

namespace skein {

/// What the mean step of a run is expected to be, and to take.
struct ExpectedStep {
  double dt = 0.0;  ///< time
  double evaluations = 1.0;
  double work = 1.0;  ///< with all else that it does, in evaluations
};

/// What a preconditioner takes, in evaluations: properties of the size of things, not of clocks, so that what is
/// decided by them is decided alike in every run.
struct PreconditionerCost {
  double factorization = 0.0;
  double use = 0.0;  ///< of the inverse, once
  /// Over those with the preconditioner for which select_method expects as many as were measured.
  double iterations = 1.0;
};

}  // namespace skein
