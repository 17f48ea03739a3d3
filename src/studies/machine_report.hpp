#pragma once

#include <skein/arrays/machine_peaks.hpp>

#include "runs/step_timing.hpp"
#include "runs/sum_timing.hpp"

#include <string>
#include <vector>

namespace skein {

/// What this program does on this machine, beside what the machine can do.
struct MachineReport {
  struct OfLength {
    double length;  ///< of one of the paper's fibers, by 18 nodes on a section
    StepTiming steps;
  };

  std::string device;
  MachinePeaks peaks;
  std::vector<DirectTiming> direct;
  std::vector<FmmTiming> fmm;
  std::vector<OfLength> lengths;

  /// Of the peak of a precision, by the operations of pairs.
  double share_of_peak(const DirectTiming& timing) const;
};

/// Needs Kokkos. @param seconds_each  of wall time for the steps of each length, and at most for one direct sum
MachineReport measure_machine(const std::string& device, const std::vector<double>& lengths, double seconds_each);

/// Tables for people, and the same as one JSON object in SI units of time.
std::string describe_machine(const MachineReport& report);
std::string write_machine_json(const MachineReport& report);

}  // namespace skein
