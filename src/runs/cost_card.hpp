#pragma once

#include <skein/physics/error_record.hpp>

#include <cstdint>
#include <string>

namespace skein {

/// What a run took and where its time went.
struct CostCard {
  double seconds = 0.0;                                   ///< wall time of this process
  double seconds_before = 0.0;                            ///< of those whose work it took over
  std::int64_t steps = 0, rejected = 0, evaluations = 0;  ///< of this process
  double pairs = 0.0;                                     ///< that a direct sum would have needed, of this process
  double fluid = 0.0;                                     ///< seconds in each part, as all below
  double springs_and_flow = 0.0;
  double integrator = 0.0;
  double observables = 0.0;
  double output = 0.0;  ///< frames and checkpoints
  double megabytes = 0.0;
  double largest_error = 0.0;    ///< of a step, over the tolerance; 0 where the method has no estimate
  double estimated_error = 0.0;  ///< of the positions: sum of the steps' estimates in the whole run, fiber lengths
  std::string mobility;          ///< as it describes itself
  ErrorRecord velocity_errors;   ///< of the whole run
  double direct_seconds = 0.0;   ///< that direct sums would have taken, estimated; 0 where that is the method
};

/// Several lines; shares of the wall time in percent.
std::string describe_cost(const CostCard& card);

}  // namespace skein
