#pragma once

namespace skein {

/// What a machine does at its best, measured, for the execution space of this build. Sums and steps are shares of it.
struct MachinePeaks {
  double double_operations = 0.0;  ///< a second: multiplications, additions, and both fused, each one operation
  double single_operations = 0.0;
  double bandwidth = 0.0;  ///< bytes a second to and from memory, of adding two long arrays
  double launch = 0.0;     ///< seconds from one small kernel to the next
  double graph = 0.0;      ///< the same in a graph of kernels, launched as a whole
  double wait = 0.0;       ///< seconds of a small kernel whose end is waited for
};

/// Takes about a second.
MachinePeaks measure_machine_peaks();

}  // namespace skein
