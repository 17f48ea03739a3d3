#pragma once

#include <skein/io/checkpoint.hpp>
#include <skein/io/run_folder.hpp>

#include <cstdint>
#include <string>

namespace skein {

/// How far a trajectory on disk goes: it ends with a segment. A checkpoint stores it, and a run that goes on begins
/// there; what lies behind it is computed again.
struct TrajectoryEnd {
  std::int64_t segments = 0;
  std::int64_t frames = 0;
  std::int64_t records = 0;
  std::string checksum;  ///< end of the chain of segments, 16 hexadecimal digits
};

/// Of a trajectory without frames.
TrajectoryEnd find_trajectory_start(const RunFolder& folder);

void write_trajectory_end(Checkpoint& checkpoint, const TrajectoryEnd& end);
TrajectoryEnd read_trajectory_end(const Checkpoint& checkpoint);  ///< @throws Error(damaged_data)

/// Looks at the segments up to `end` by their labels. @param check_seals  read all bytes, too
/// @throws Error(damaged_data), Error(io_error) saying what is missing, wrong or cannot be read
void check_trajectory(const RunFolder& folder, const TrajectoryEnd& end, bool check_seals);

}  // namespace skein
