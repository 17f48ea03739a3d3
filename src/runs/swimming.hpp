#pragma once

#include "runs/run_analysis.hpp"

#include <cstddef>
#include <optional>

namespace skein {

/// What a fiber that undulates came to in a period of its slowest wave.
struct Swimming {
  double begin = 0.0, end = 0.0;  ///< of the run's last period, time
  Vec3 velocity;                  ///< of the mean of its nodes, mean of the period, length / time
  double power = 0.0;             ///< that the fluid turns into heat, mean of the period, force * length / time
  double towing_power = 0.0;      ///< to pull the straight rigid fiber along itself at this speed
  double efficiency() const { return towing_power / power; }
};

/// None where the fiber has no wave that travels or beats, where the fluid flows by itself, without forces, and where
/// frames do not show a whole period after the waves have risen, by eight frames at least.
std::optional<Swimming> measure_swimming(const RunAnalysis& analysis, std::size_t fiber);

}  // namespace skein
