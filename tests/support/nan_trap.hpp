#pragma once

namespace skein::test {

/// True where the tests stop at the operation that makes a NaN, or divides by zero: with SKEIN_TRAP_NAN in the
/// environment, on Linux with glibc. Elsewhere this file does nothing.
bool traps_nan();

/// Sets or removes the trap on every host thread; each has its own.
void set_nan_trap(bool on);

/// Switches the trap off while it lives: for tests in which NaN is meant, and tells the reader where.
class MeantNan {
 public:
  MeantNan() { set_nan_trap(false); }
  ~MeantNan() { set_nan_trap(traps_nan()); }
  MeantNan(const MeantNan&) = delete;
  MeantNan& operator=(const MeantNan&) = delete;
};

}  // namespace skein::test
