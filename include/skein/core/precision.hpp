#pragma once

#include <skein/core/error.hpp>

namespace skein {

/// Of floating-point numbers: double has 16 digits, single 7. `automatic` leaves it to the computation, which knows
/// what its tolerance allows.
enum class Precision { automatic, in_double, in_single };

/// Calls use(double{}) or use(float{}).
/// @throws Error(internal) for `automatic`: the choice must have been made by then
template <class Use>
void with_precision(const Precision precision, const Use& use) {
  switch (precision) {
    case Precision::in_double:
      use(double{});
      return;
    case Precision::in_single:
      use(float{});
      return;
    case Precision::automatic:
      break;
  }
  throw Error(ExitCode::internal, "a precision is neither double nor single where one of them is needed");
}

/// 8 or 4. @throws Error(internal) for `automatic`
inline int bytes_per_number(const Precision precision) {
  int n_bytes = 0;
  with_precision(precision, [&](const auto number) { n_bytes = static_cast<int>(sizeof number); });
  return n_bytes;
}

}  // namespace skein
