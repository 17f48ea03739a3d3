#pragma once

#include <skein/arrays/types.hpp>

namespace skein {

/// A linear map A of vectors on nodes, [n_nodes, 3], with an approximate inverse of I - scale A, the scale being the
/// one that it was made for. One call at a time.
class LinearOperator {
 public:
  virtual ~LinearOperator() = default;

  /// Overwrites result with A v.
  virtual void multiply(const ConstVectors& v, const Vectors& result) = 0;

  /// Overwrites result with the approximate inverse times v. result may be v.
  virtual void precondition(const ConstVectors& v, const Vectors& result) = 0;
};

}  // namespace skein
